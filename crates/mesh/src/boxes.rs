//! A tree of bounding boxes, for all pairs of things that may touch.

use std::ops::ControlFlow;

use nalgebra::Vector3;

/// Things of a leaf.
const LEAF: usize = 4;

/// Smallest and largest coordinates, m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub least: Vector3<f64>,
    pub largest: Vector3<f64>,
}

impl Bounds {
    /// Bounds of some points.
    pub(crate) fn of(points: &[Vector3<f64>]) -> Self {
        let empty = Self { least: Vector3::repeat(f64::INFINITY), largest: Vector3::repeat(f64::NEG_INFINITY) };
        points.iter().fold(empty, |all, x| Self { least: all.least.inf(x), largest: all.largest.sup(x) })
    }

    /// Returns true if two boxes have a common point.
    pub(crate) fn touches(&self, other: &Self) -> bool {
        (0..3).all(|i| self.least[i] <= other.largest[i] && other.least[i] <= self.largest[i])
    }

    /// A box around both.
    pub(crate) fn join(&self, other: &Self) -> Self {
        Self { least: self.least.inf(&other.least), largest: self.largest.sup(&other.largest) }
    }
}

/// Boxes of things, halved at the median along the longest side.
pub(crate) struct BoxTree {
    nodes: Vec<Node>,
    /// The things in the order of the leaves, with their boxes.
    things: Vec<(usize, Bounds)>,
}

struct Node {
    bounds: Bounds,
    first: usize,
    end: usize,
    /// The second of its two parts; the first follows it. Zero for a leaf.
    second: usize,
}

impl BoxTree {
    /// A tree over boxes with finite numbers, each with the index of its thing.
    pub(crate) fn new(mut things: Vec<(usize, Bounds)>) -> Self {
        let mut nodes = Vec::new();
        let count = things.len();
        if count > 0 {
            build(&mut things, 0, count, &mut nodes);
        }
        Self { nodes, things }
    }

    /// Calls a function with every pair of things whose boxes touch, once for each, in an order that depends on the boxes alone, until it
    /// breaks.
    pub(crate) fn pairs(&self, mut call: impl FnMut(usize, usize) -> ControlFlow<()>) -> ControlFlow<()> {
        let mut open = if self.nodes.is_empty() { vec![] } else { vec![(0, 0)] };
        while let Some((a, b)) = open.pop() {
            let (first, second) = (&self.nodes[a], &self.nodes[b]);
            if a == b {
                if first.second == 0 {
                    self.pairs_of_leaves(first, second, &mut call)?;
                } else {
                    open.extend([(a + 1, first.second), (first.second, first.second), (a + 1, a + 1)]);
                }
            } else if first.bounds.touches(&second.bounds) {
                match (first.second, second.second) {
                    (0, 0) => self.pairs_of_leaves(first, second, &mut call)?,
                    (parts, other)
                        if other == 0 || parts != 0 && first.end - first.first >= second.end - second.first =>
                    {
                        open.extend([(a + 1, b), (parts, b)]);
                    }
                    (_, parts) => open.extend([(a, b + 1), (a, parts)]),
                }
            }
        }
        ControlFlow::Continue(())
    }

    fn pairs_of_leaves(
        &self,
        a: &Node,
        b: &Node,
        call: &mut impl FnMut(usize, usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for i in a.first..a.end {
            let (one, bounds) = &self.things[i];
            for (other, others) in &self.things[b.first.max(if a.first == b.first { i + 1 } else { 0 })..b.end] {
                if bounds.touches(others) {
                    call(*one, *other)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Calls a function with every thing whose box touches a box.
    pub(crate) fn touching(&self, bounds: &Bounds, mut call: impl FnMut(usize)) {
        let mut open = if self.nodes.is_empty() { vec![] } else { vec![0] };
        while let Some(at) = open.pop() {
            let node = &self.nodes[at];
            if !node.bounds.touches(bounds) {
                continue;
            }
            if node.second == 0 {
                let touching = self.things[node.first..node.end].iter().filter(|(_, own)| own.touches(bounds));
                touching.for_each(|&(thing, _)| call(thing));
            } else {
                open.extend([at + 1, node.second]);
            }
        }
    }
}

fn build(things: &mut [(usize, Bounds)], first: usize, end: usize, nodes: &mut Vec<Node>) {
    let own = &mut things[first..end];
    let bounds = own[1..].iter().fold(own[0].1, |all, (_, bounds)| all.join(bounds));
    let here = nodes.len();
    nodes.push(Node { bounds, first, end, second: 0 });
    if end - first <= LEAF {
        return;
    }
    let axis = (bounds.largest - bounds.least).imax();
    let middle = (first + end) / 2;
    let place = |thing: &(usize, Bounds)| thing.1.least[axis] + thing.1.largest[axis];
    own.select_nth_unstable_by(middle - first, |a, b| place(a).total_cmp(&place(b)).then(a.0.cmp(&b.0)));
    build(things, first, middle, nodes);
    nodes[here].second = nodes.len();
    build(things, middle, end, nodes);
}
