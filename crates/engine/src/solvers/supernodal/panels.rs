//! Which nodes of a factor are eliminated together, and where everything goes: found once from the pattern.
//!
//! A panel is a set of consecutive columns of L with the same rows below them, stored as one dense matrix (Ashcraft and Grimes,
//! The Influence of Relaxed Supernode Partitions on the Multifrontal Method, 1989). What it subtracts from later columns is
//! gathered in a dense update matrix and handed to the panel of its first row, its parent (Duff and Reid, The Multifrontal
//! Solution of Indefinite Sparse Symmetric Linear Equations, 1983).

use std::ops::Range;

use crate::sparse::Pattern;

/// Consecutive nodes that are eliminated together. Sizes are in nodes unless they say scalars.
pub struct Panel {
    /// Its nodes.
    pub nodes: Range<usize>,
    /// Rows below its nodes, in [`Panels::rows`].
    pub rows: Range<usize>,
    /// Blocks of the matrix that stand in it, in [`Panels::blocks`].
    pub blocks: Range<usize>,
    /// Where its rows go in the parent's front, in [`Panels::runs`].
    pub runs: Range<usize>,
    /// Its columns in L, scalars.
    pub columns: Range<usize>,
    /// Scalars from one column of L to the next.
    pub stride: usize,
    /// Scalars from one column of its update matrix to the next.
    pub update_stride: usize,
    /// Panels whose update matrices it takes over, in [`Panels::children`].
    pub children: Range<usize>,
}

/// `count` rows that stand next to each other in a panel's update matrix and in its parent's front.
#[derive(Clone, Copy)]
pub struct Run {
    pub from: u32,
    pub to: u32,
    pub count: u32,
}

/// The plan of a factorisation.
pub struct Panels {
    /// Children before parents, and the children of one panel on top of the stack when its turn comes.
    pub panels: Vec<Panel>,
    pub rows: Vec<u32>,
    /// Number of a block of the matrix, and its place in L: scalars.
    pub blocks: Vec<(u32, usize)>,
    pub runs: Vec<Run>,
    /// Numbers of panels.
    pub children: Vec<usize>,
    /// Scalars of L.
    pub len_L: usize,
    /// Most scalars of update matrices at one time.
    pub len_updates: usize,
}

impl Panel {
    /// Rows below its nodes.
    pub fn below(&self) -> usize {
        self.rows.len()
    }

    /// Scalars of its update matrix.
    pub fn len_update(&self) -> usize {
        3 * self.below() * self.update_stride
    }
}

/// Columns and the rows below, before they are put into order.
struct Draft {
    nodes: Range<usize>,
    rows: Vec<u32>,
    /// Blocks of the two that are kept though they are zero.
    zeros: usize,
}

impl Panels {
    /// The plan for a pattern of which the lower half is stored, with columns of whole registers of `lanes` scalars.
    pub fn new(pattern: &Pattern, lanes: usize) -> Self {
        let drafts = merge(columns(pattern));
        let parents = parents(&drafts, pattern.rows());
        let order = postorder(&parents);
        let mut plan = Self {
            panels: vec![],
            rows: vec![],
            blocks: vec![],
            runs: vec![],
            children: vec![],
            len_L: 0,
            len_updates: 0,
        };
        for &draft in &order {
            plan.push(&drafts[draft], parents[draft].map(|parent| &drafts[parent]), lanes);
        }
        plan.stack(&parents, &order);
        plan.place_blocks(pattern);
        plan
    }

    /// The panels whose update matrices a panel takes over, in the order in which they lie on the stack.
    pub fn children(&self, panel: usize) -> std::iter::Copied<std::slice::Iter<'_, usize>> {
        let panel = &self.panels[panel];
        self.children[panel.children.clone()].iter().copied()
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of_val(self.panels.as_slice())
            + size_of_val(self.children.as_slice())
            + size_of_val(self.rows.as_slice())
            + size_of_val(self.blocks.as_slice())
            + size_of_val(self.runs.as_slice())
    }

    fn push(&mut self, draft: &Draft, parent: Option<&Draft>, lanes: usize) {
        let (width, below) = (3 * draft.nodes.len(), 3 * draft.rows.len());
        let update_stride = below.next_multiple_of(lanes);
        let stride = (width + update_stride).next_multiple_of(lanes);
        let rows = self.rows.len()..self.rows.len() + draft.rows.len();
        self.rows.extend(&draft.rows);
        let runs = self.runs.len();
        if let Some(parent) = parent {
            self.runs.extend(find_runs(&draft.rows, parent));
        }
        let columns = self.len_L..self.len_L + width * stride;
        self.len_L = columns.end;
        let (nodes, runs) = (draft.nodes.clone(), runs..self.runs.len());
        self.panels.push(Panel { nodes, rows, blocks: 0..0, runs, columns, stride, update_stride, children: 0..0 });
    }

    fn place_blocks(&mut self, pattern: &Pattern) {
        let mut panel_of = vec![0u32; pattern.rows()];
        for (number, panel) in self.panels.iter().enumerate() {
            panel_of[panel.nodes.clone()].fill(number as u32);
        }
        let blocks = (0..pattern.rows()).flat_map(|row| pattern.row(row).map(move |block| (row, block)));
        let mut placed: Vec<(u32, u32, usize)> = blocks
            .map(|(row, block)| {
                let column = pattern.columns[block] as usize;
                let number = panel_of[column];
                let panel = &self.panels[number as usize];
                let place = panel.columns.start + 3 * (column - panel.nodes.start) * panel.stride;
                (number, block as u32, place + 3 * front_row(row as u32, &panel.nodes, &self.rows[panel.rows.clone()]))
            })
            .collect();
        placed.sort_unstable();
        let mut start = 0;
        for (number, panel) in self.panels.iter_mut().enumerate() {
            let count = placed[start..].iter().take_while(|place| place.0 as usize == number).count();
            panel.blocks = start..start + count;
            start += count;
        }
        self.blocks = placed.into_iter().map(|(_, block, place)| (block, place)).collect();
    }

    /// Finds each panel's children and how high the stack of update matrices grows. A panel's own is computed above those of
    /// its children, then moved down to where theirs began.
    fn stack(&mut self, parents: &[Option<usize>], order: &[usize]) {
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(panel, &draft)| place[draft] = panel);
        let parents: Vec<Option<usize>> =
            order.iter().map(|&draft| parents[draft].map(|parent| place[parent])).collect();
        let (mut stack, mut len): (Vec<usize>, usize) = (Vec::new(), 0);
        for number in 0..self.panels.len() {
            let own = self.panels[number].len_update();
            self.len_updates = self.len_updates.max(len + own);
            let first = stack.iter().rposition(|&child| parents[child] != Some(number)).map_or(0, |last| last + 1);
            let start = self.children.len();
            self.children.extend(stack.drain(first..));
            len -= self.children[start..].iter().map(|&child| self.panels[child].len_update()).sum::<usize>();
            self.panels[number].children = start..self.children.len();
            stack.push(number);
            len += own;
        }
    }
}

/// The place of a row in the front of a panel: its nodes first, then the rows below.
fn front_row(row: u32, nodes: &Range<usize>, rows: &[u32]) -> usize {
    if nodes.contains(&(row as usize)) {
        row as usize - nodes.start
    } else {
        nodes.len() + rows.partition_point(|&below| below < row)
    }
}

fn find_runs(rows: &[u32], parent: &Draft) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (from, &row) in rows.iter().enumerate() {
        let to = front_row(row, &parent.nodes, &parent.rows) as u32;
        match runs.last_mut() {
            // no run crosses from the parent's columns to its update matrix
            Some(run) if run.to + run.count == to && to as usize != parent.nodes.len() => run.count += 1,
            _ => runs.push(Run { from: from as u32, to, count: 1 }),
        }
    }
    runs
}

/// Columns of L, those next to each other with the same rows together.
fn columns(pattern: &Pattern) -> Vec<Draft> {
    let mut below: Vec<Vec<u32>> = vec![Vec::new(); pattern.rows()];
    for row in 0..pattern.rows() {
        for &column in &pattern.columns[pattern.row(row)] {
            if (column as usize) < row {
                below[column as usize].push(row as u32);
            }
        }
    }
    let mut drafts: Vec<Draft> = Vec::new();
    // the drafts that hand their rows on to each node
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); pattern.rows()];
    for node in 0..pattern.rows() {
        let mut rows = std::mem::take(&mut below[node]);
        for &child in &children[node] {
            rows.extend(drafts[child].rows.iter().filter(|&&row| row as usize > node));
        }
        rows.sort_unstable();
        rows.dedup();
        // A draft whose rows are this node and the node's rows takes it in.
        match drafts.last_mut() {
            Some(last) if last.rows.first() == Some(&(node as u32)) && last.rows.len() == rows.len() + 1 => {
                last.nodes.end = node + 1;
                last.rows = rows;
            }
            _ => drafts.push(Draft { nodes: node..node + 1, rows, zeros: 0 }),
        }
        let last = drafts.len() - 1;
        if let Some(&parent) = drafts[last].rows.first() {
            children[parent as usize].push(last);
        }
    }
    drafts
}

/// Joins a panel with the one after it, its parent, where that keeps few zeros: fewer and larger panels are faster.
fn merge(drafts: Vec<Draft>) -> Vec<Draft> {
    let mut merged: Vec<Draft> = Vec::new();
    for draft in drafts {
        let mut current = draft;
        while let Some(last) = merged.last() {
            let Some(zeros) = zeros_of(last, &current) else { break };
            let nodes = last.nodes.start..current.nodes.end;
            merged.pop();
            current = Draft { nodes, zeros, ..current };
        }
        merged.push(current);
    }
    merged
}

/// Zeros that the joined panel would hold, where that is worth it.
fn zeros_of(child: &Draft, parent: &Draft) -> Option<usize> {
    if child.rows.first() != Some(&(parent.nodes.start as u32)) {
        return None;
    }
    let width = child.nodes.len() + parent.nodes.len();
    let added = child.nodes.len() * (parent.nodes.len() + parent.rows.len() - child.rows.len());
    let zeros = child.zeros + parent.zeros + added;
    let all = width * (width + 1) / 2 + width * parent.rows.len();
    let share = zeros as f64 / all as f64;
    let worth = width <= 2 || (width <= 6 && share < 0.5) || (width <= 16 && share < 0.15) || share < 0.05;
    worth.then_some(zeros)
}

/// The draft that holds the first row of each.
fn parents(drafts: &[Draft], nodes: usize) -> Vec<Option<usize>> {
    let mut draft_of = vec![0; nodes];
    for (number, draft) in drafts.iter().enumerate() {
        draft_of[draft.nodes.clone()].fill(number);
    }
    drafts.iter().map(|draft| draft.rows.first().map(|&row| draft_of[row as usize])).collect()
}

/// Each one after all that are below it, and those directly before it.
fn postorder(parents: &[Option<usize>]) -> Vec<usize> {
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); parents.len()];
    for (number, parent) in parents.iter().enumerate() {
        if let Some(parent) = *parent {
            children[parent].push(number);
        }
    }
    let roots = (0..parents.len()).filter(|&number| parents[number].is_none());
    let mut stack: Vec<usize> = roots.collect();
    // a preorder backwards is a postorder
    let mut order = Vec::with_capacity(parents.len());
    while let Some(number) = stack.pop() {
        order.push(number);
        stack.extend(&children[number]);
    }
    order.reverse();
    order
}
