//! Symbolic factorisation: the supernodes of a factor and the assembly of their fronts, found once from the pattern.
//!
//! A supernode is a set of consecutive columns of L with the same rows below them, stored as one dense matrix (Ashcraft and
//! Grimes, The Influence of Relaxed Supernode Partitions on the Multifrontal Method, 1989). Its contribution to later columns
//! is gathered in a dense update matrix, which is assembled into the front of its parent, the supernode of its first row below
//! (Duff and Reid, The Multifrontal Solution of Indefinite Sparse Symmetric Linear Equations, 1983).

use std::ops::Range;

use fem_elements::sparse::Pattern;

/// Smallest number of multiplications of a large subtree: they take about a millisecond, and waking a thread some microseconds.
const LARGE: f64 = 8e6;

/// Smallest share of a large subtree in all multiplications. With smaller ones update matrices would take more memory.
const SHARE: f64 = 1.0 / 8.0;

/// Consecutive nodes that are eliminated together. Sizes are in nodes unless they say scalars.
pub struct Supernode {
    pub nodes: Range<usize>,
    /// Its part of a vector in postorder, scalars.
    pub diagonal: Range<usize>,
    /// Rows below its nodes, in [`SymbolicFactor::rows`].
    pub rows: Range<usize>,
    /// Blocks of the matrix in its columns, in [`SymbolicFactor::blocks`].
    pub blocks: Range<usize>,
    /// Its rows in the parent's front, in [`SymbolicFactor::ranges`].
    pub ranges: Range<usize>,
    /// Its columns in L, scalars.
    pub columns: Range<usize>,
    /// Scalars from one column of L to the next.
    pub stride: usize,
    /// Number of rows below its columns, and so of columns of its update matrix, scalars.
    pub below: usize,
    /// Rows of its update matrix with those that fill up the last register, scalars.
    pub update_rows: usize,
    /// Supernodes whose update matrices are assembled into its front, in [`SymbolicFactor::children`].
    pub children: Range<usize>,
    /// True if its subtree takes long enough for a thread of its own.
    pub is_large: bool,
}

/// `count` rows that are contiguous both in a supernode's update matrix, at `from`, and in its parent's front, at `to`.
#[derive(Clone, Copy)]
pub struct RowRange<N = u32> {
    pub from: N,
    pub to: N,
    pub count: N,
}

impl RowRange {
    /// The same in scalars, of which a row has D.
    #[inline(always)]
    pub fn scalars<const D: usize>(self) -> RowRange<usize> {
        RowRange { from: D * self.from as usize, to: D * self.to as usize, count: D * self.count as usize }
    }
}

/// The symbolic factorisation of a pattern.
pub struct SymbolicFactor {
    /// In postorder: children before parents, the update matrices of one parent's children on top of the stack.
    pub supernodes: Vec<Supernode>,
    pub rows: Vec<u32>,
    /// Number of a block of the matrix, and the index in L of its first scalar.
    pub blocks: Vec<(u32, usize)>,
    pub ranges: Vec<RowRange>,
    /// Numbers of supernodes.
    pub children: Vec<usize>,
    /// Supernodes without a parent.
    pub roots: Vec<usize>,
    /// Scalars of L.
    pub len_L: usize,
}

/// Columns of an update matrix that are stored together, from the row of the first one's diagonal entry on: nearly the lower half alone. A multiple
/// of the scalars of a register, of the columns that a kernel processes together, and of the scalars of a node.
const BLOCK: usize = 192;

impl Supernode {
    /// Scalars of its update matrix.
    pub fn len_update(&self) -> usize {
        let last = self.update_blocks().saturating_sub(1);
        let Range { start, end } = self.update_columns(last);
        self.start_of_update(last) + (end - start) * (self.update_rows - start)
    }

    /// Number of the blocks of columns in which its update matrix is stored.
    pub fn update_blocks(&self) -> usize {
        self.below.div_ceil(BLOCK)
    }

    /// The columns of such a block. The first is also the first row that is stored.
    pub fn update_columns(&self, block: usize) -> Range<usize> {
        block * BLOCK..(block * BLOCK + BLOCK).min(self.below)
    }

    /// The first scalar of such a block.
    pub fn start_of_update(&self, block: usize) -> usize {
        BLOCK * (block * self.update_rows - BLOCK * (block * block.saturating_sub(1) / 2))
    }

    /// The place of a column of its update matrix from which its rows are counted; those before its block are not stored.
    #[inline(always)]
    pub fn update_column(&self, column: usize) -> usize {
        if column < BLOCK {
            return column * self.update_rows; // as in most fronts
        }
        let block = column / BLOCK;
        let row = block * BLOCK;
        self.start_of_update(block) + (column - row) * (self.update_rows - row) - row
    }
}

/// A supernode before it has its place in postorder.
struct Draft {
    nodes: Range<usize>,
    rows: Vec<u32>,
    /// Zero blocks that are stored because supernodes were merged.
    zeros: usize,
}

impl SymbolicFactor {
    /// Symbolic factorisation of a pattern that stores the lower half, in blocks of `size` rows and columns. Columns of L are padded to a
    /// multiple of `lanes` scalars.
    pub fn new(pattern: &Pattern, size: usize, lanes: usize) -> Self {
        let drafts = merge(fundamental_supernodes(pattern), size);
        let parents = parents(&drafts, pattern.rows());
        let is_large = large_subtrees(&drafts, &parents, size);
        let postorder = postorder(&parents, &is_large);
        let mut symbolic = Self {
            supernodes: vec![],
            rows: vec![],
            blocks: vec![],
            ranges: vec![],
            children: vec![],
            roots: vec![],
            len_L: 0,
        };
        for &draft in &postorder {
            symbolic.push(&drafts[draft], parents[draft].map(|parent| &drafts[parent]), size, lanes);
            symbolic.supernodes.last_mut().into_iter().for_each(|supernode| supernode.is_large = is_large[draft]);
        }
        symbolic.find_children(&parents, &postorder);
        symbolic.place_blocks(pattern, size);
        symbolic
    }

    /// The children of a supernode, in postorder.
    pub fn children(&self, supernode: usize) -> &[usize] {
        &self.children[self.supernodes[supernode].children.clone()]
    }

    /// Scalars of the update matrices of these supernodes.
    pub fn len_updates_of(&self, supernodes: &[usize]) -> usize {
        supernodes.iter().map(|&number| self.supernodes[number].len_update()).sum()
    }

    pub fn bytes(&self) -> usize {
        size_of_val(self.supernodes.as_slice())
            + size_of_val(self.children.as_slice())
            + size_of_val(self.rows.as_slice())
            + size_of_val(self.blocks.as_slice())
            + size_of_val(self.ranges.as_slice())
    }

    fn push(&mut self, draft: &Draft, parent: Option<&Draft>, size: usize, lanes: usize) {
        let (width, below) = (size * draft.nodes.len(), size * draft.rows.len());
        let update_rows = below.next_multiple_of(lanes);
        let stride = (width + update_rows).next_multiple_of(lanes);
        let rows = self.rows.len()..self.rows.len() + draft.rows.len();
        self.rows.extend(&draft.rows);
        let ranges = self.ranges.len();
        if let Some(parent) = parent {
            self.ranges.extend(row_ranges(&draft.rows, parent));
        }
        let columns = self.len_L..self.len_L + width * stride;
        self.len_L = columns.end;
        let first = self.supernodes.last().map_or(0, |last| last.diagonal.end);
        let (nodes, ranges) = (draft.nodes.clone(), ranges..self.ranges.len());
        self.supernodes.push(Supernode {
            nodes,
            diagonal: first..first + width,
            rows,
            blocks: 0..0,
            ranges,
            columns,
            stride,
            below,
            update_rows,
            children: 0..0,
            is_large: false,
        });
    }

    /// Finds the place in L of each block of the matrix.
    fn place_blocks(&mut self, pattern: &Pattern, size: usize) {
        let mut supernode_of = vec![0u32; pattern.rows()];
        for (number, supernode) in self.supernodes.iter().enumerate() {
            supernode_of[supernode.nodes.clone()].fill(number as u32);
        }
        let blocks = (0..pattern.rows()).flat_map(|row| pattern.row(row).map(move |block| (row, block)));
        let mut placed: Vec<(u32, u32, usize)> = blocks
            .map(|(row, block)| {
                let column = pattern.columns[block] as usize;
                let number = supernode_of[column];
                let Supernode { nodes, rows, columns, stride, .. } = &self.supernodes[number as usize];
                let place = columns.start + size * (column - nodes.start) * stride;
                (number, block as u32, place + size * front_row(row as u32, nodes, &self.rows[rows.clone()]))
            })
            .collect();
        placed.sort_unstable();
        let mut start = 0;
        for (number, supernode) in self.supernodes.iter_mut().enumerate() {
            let count = placed[start..].iter().take_while(|place| place.0 as usize == number).count();
            supernode.blocks = start..start + count;
            start += count;
        }
        self.blocks = placed.into_iter().map(|(_, block, place)| (block, place)).collect();
    }

    /// Finds the children of each supernode.
    fn find_children(&mut self, parents: &[Option<usize>], postorder: &[usize]) {
        let mut number_of = vec![0; postorder.len()];
        postorder.iter().enumerate().for_each(|(number, &draft)| number_of[draft] = number);
        let mut waiting: Vec<usize> = Vec::new();
        let parent_of = |number: usize| parents[postorder[number]].map(|parent| number_of[parent]);
        for number in 0..self.supernodes.len() {
            let first = waiting.iter().rposition(|&child| parent_of(child) != Some(number)).map_or(0, |last| last + 1);
            let start = self.children.len();
            self.children.extend(waiting.drain(first..));
            self.supernodes[number].children = start..self.children.len();
            waiting.push(number);
        }
        self.roots = waiting;
    }
}

/// The position of a row in the front of a supernode, which lists its nodes first, then the rows below.
fn front_row(row: u32, nodes: &Range<usize>, rows: &[u32]) -> usize {
    if nodes.contains(&(row as usize)) {
        row as usize - nodes.start
    } else {
        nodes.len() + rows.partition_point(|&below| below < row)
    }
}

/// The rows of an update matrix in the front of its parent.
fn row_ranges(rows: &[u32], parent: &Draft) -> Vec<RowRange> {
    let mut ranges: Vec<RowRange> = Vec::new();
    for (from, &row) in rows.iter().enumerate() {
        let to = front_row(row, &parent.nodes, &parent.rows) as u32;
        match ranges.last_mut() {
            // A range ends where the parent's own columns end and its update matrix begins.
            Some(range) if range.to + range.count == to && to as usize != parent.nodes.len() => range.count += 1,
            _ => ranges.push(RowRange { from: from as u32, to, count: 1 }),
        }
    }
    ranges
}

/// Fundamental supernodes: consecutive columns of L with the same rows below them.
fn fundamental_supernodes(pattern: &Pattern) -> Vec<Draft> {
    let mut below: Vec<Vec<u32>> = vec![Vec::new(); pattern.rows()];
    for row in 0..pattern.rows() {
        for &column in &pattern.columns[pattern.row(row)] {
            if (column as usize) < row {
                below[column as usize].push(row as u32);
            }
        }
    }
    let mut drafts: Vec<Draft> = Vec::new();
    // The drafts whose first row below is each node: their other rows are rows of the node as well.
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); pattern.rows()];
    for node in 0..pattern.rows() {
        let mut rows = std::mem::take(&mut below[node]);
        for &child in &children[node] {
            rows.extend(drafts[child].rows.iter().filter(|&&row| row as usize > node));
        }
        rows.sort_unstable();
        rows.dedup();
        // The node joins the last draft if that has this node and the node's rows below it.
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

/// Merges a supernode with the one after it, its parent, where few zeros are stored for it: fewer and larger supernodes are
/// faster.
fn merge(drafts: Vec<Draft>, size: usize) -> Vec<Draft> {
    let mut merged: Vec<Draft> = Vec::new();
    for draft in drafts {
        let mut current = draft;
        while let Some(last) = merged.last() {
            let Some(zeros) = zeros_if_worthwhile(last, &current, size) else { break };
            let nodes = last.nodes.start..current.nodes.end;
            merged.pop();
            current = Draft { nodes, zeros, ..current };
        }
        merged.push(current);
    }
    merged
}

/// Zero blocks that the merged supernode would store; `None` if it would not be faster.
fn zeros_if_worthwhile(child: &Draft, parent: &Draft, size: usize) -> Option<usize> {
    if child.rows.first() != Some(&(parent.nodes.start as u32)) {
        return None;
    }
    let width = child.nodes.len() + parent.nodes.len();
    let added = child.nodes.len() * (parent.nodes.len() + parent.rows.len() - child.rows.len());
    let zeros = child.zeros + parent.zeros + added;
    let all = width * (width + 1) / 2 + width * parent.rows.len();
    let share = zeros as f64 / all as f64;
    let width = size * width;
    let worth = width <= 6 || (width <= 18 && share < 0.5) || (width <= 48 && share < 0.15) || share < 0.05;
    worth.then_some(zeros)
}

/// Parent of each draft: the draft that contains its first row below.
fn parents(drafts: &[Draft], nodes: usize) -> Vec<Option<usize>> {
    let mut draft_of = vec![0; nodes];
    for (number, draft) in drafts.iter().enumerate() {
        draft_of[draft.nodes.clone()].fill(number);
    }
    drafts.iter().map(|draft| draft.rows.first().map(|&row| draft_of[row as usize])).collect()
}

/// For each draft, true if the elimination of its subtree takes long.
fn large_subtrees(drafts: &[Draft], parents: &[Option<usize>], size: usize) -> Vec<bool> {
    let multiplications = |draft: &Draft| {
        let [width, below] = [draft.nodes.len(), draft.rows.len()].map(|nodes| (size * nodes) as f64);
        width * (width * width / 6.0 + 0.5 * below * (width + below))
    };
    let mut work: Vec<f64> = drafts.iter().map(multiplications).collect();
    for (draft, parent) in parents.iter().enumerate() {
        // A parent comes after its children.
        if let Some(parent) = *parent {
            work[parent] += work[draft];
        }
    }
    let all: f64 = (0..drafts.len()).filter(|&draft| parents[draft].is_none()).map(|root| work[root]).sum();
    work.into_iter().map(|work| work > LARGE.max(SHARE * all)).collect()
}

/// Numbers in postorder: each parent directly after the subtrees of its children, of which large ones come first.
fn postorder(parents: &[Option<usize>], is_large: &[bool]) -> Vec<usize> {
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); parents.len()];
    for (number, parent) in parents.iter().enumerate() {
        if let Some(parent) = *parent {
            children[parent].push(number);
        }
    }
    children.iter_mut().for_each(|children| children.sort_by_key(|&child| !is_large[child]));
    let mut stack: Vec<usize> = (0..parents.len()).filter(|&number| parents[number].is_none()).collect();
    stack.sort_by_key(|&root| !is_large[root]);
    // A preorder backwards is a postorder.
    let mut order = Vec::with_capacity(parents.len());
    while let Some(number) = stack.pop() {
        order.push(number);
        stack.extend(&children[number]);
    }
    order.reverse();
    order
}
