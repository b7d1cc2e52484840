//! Colours for sweeps: nodes of one colour have no common element or spring, constraints of one colour no common node, so that all of a colour
//! are moved side by side.

/// Groups the nodes by colour: each node has the first colour that none of its neighbours has. Nodes of a colour ascend.
pub(crate) fn color_nodes(nodes: usize, cliques: &[&[u32]]) -> Vec<Vec<u32>> {
    let (starts, around) = cliques_of_nodes(nodes, cliques);
    let mut colors: Vec<Vec<u32>> = Vec::new();
    let mut of_node = vec![u32::MAX; nodes];
    // The node that has last excluded each colour.
    let mut excluded_by: Vec<usize> = Vec::new();
    for node in 0..nodes {
        for &clique in &around[starts[node]..starts[node + 1]] {
            for &neighbor in cliques[clique as usize] {
                if let Some(by) = excluded_by.get_mut(of_node[neighbor as usize] as usize) {
                    *by = node;
                }
            }
        }
        let color = (0..colors.len()).find(|&color| excluded_by[color] != node).unwrap_or(colors.len());
        if color == colors.len() {
            colors.push(Vec::new());
            excluded_by.push(usize::MAX);
        }
        colors[color].push(node as u32);
        of_node[node] = color as u32;
    }
    colors
}

/// Groups constraints by colour in the same way: two constraints with a common node are neighbours. This is the greedy colouring of
/// Fratarcangeli, Tibaldo and Pellacini, Vivace: a practical Gauss–Seidel method for stable soft body dynamics (2016), without its random choices.
pub fn color_constraints<const N: usize>(nodes: usize, constraints: &[[u32; N]]) -> Vec<Vec<u32>> {
    let (starts, numbers) = cliques_of_nodes(nodes, constraints);
    let of_nodes: Vec<_> = starts.windows(2).map(|ends| &numbers[ends[0]..ends[1]]).collect();
    color_nodes(constraints.len(), &of_nodes)
}

/// The cliques (elements and springs, as sets of coupled nodes) of each node: those of node i are `numbers[starts[i]..starts[i + 1]]`, in ascending order.
pub fn cliques_of_nodes<C: AsRef<[u32]>>(nodes: usize, cliques: &[C]) -> (Vec<usize>, Vec<u32>) {
    let mut starts = vec![0; nodes + 1];
    let members = || cliques.iter().enumerate().flat_map(|(i, clique)| clique.as_ref().iter().map(move |&n| (i, n)));
    members().for_each(|(_, node)| starts[node as usize + 1] += 1);
    for node in 0..nodes {
        starts[node + 1] += starts[node];
    }
    let (mut next, mut numbers) = (starts.clone(), vec![0; starts[nodes]]);
    for (clique, node) in members() {
        numbers[next[node as usize]] = clique as u32;
        next[node as usize] += 1;
    }
    (starts, numbers)
}

#[cfg(test)]
mod tests {
    use super::{color_constraints, color_nodes};

    #[test]
    fn nodes_of_one_colour_are_no_neighbours_and_each_node_has_one_colour() {
        let tetrahedra: Vec<[u32; 4]> = (0..30).map(|i| [i, i + 1, i + 2, (i * 7 + 5) % 34]).collect();
        let tetrahedra: Vec<_> =
            tetrahedra.into_iter().filter(|t| !t[..3].contains(&t[3])).chain([[0, 10, 20, 33]]).collect();
        let springs = [[0, 33], [2, 31]];
        let cliques: Vec<&[u32]> = tetrahedra.iter().map(|t| &t[..]).chain(springs.iter().map(|s| &s[..])).collect();
        let colors = color_nodes(36, &cliques);
        let mut seen = colors.concat();
        seen.sort_unstable();
        assert!(seen.iter().copied().eq(0..36), "{colors:?}");
        let color = |node: u32| colors.iter().position(|color| color.contains(&node)).unwrap();
        for clique in cliques {
            for (i, &a) in clique.iter().enumerate() {
                assert!(clique[..i].iter().all(|&b| color(a) != color(b)), "{clique:?}");
            }
        }
    }

    #[test]
    fn constraints_of_one_colour_share_no_node_and_each_has_one_colour() {
        // Triangles of a strip, each pair of neighbours with two common nodes, and one far away.
        let mut triangles: Vec<[u32; 3]> = (0..40).map(|i| [i, i + 1, i + 2]).collect();
        triangles.push([60, 61, 62]);
        let colors = color_constraints(63, &triangles);
        assert_eq!(colors.len(), 3);
        let mut seen = colors.concat();
        seen.sort_unstable();
        assert!(seen.iter().enumerate().all(|(i, &number)| i == number as usize) && seen.len() == triangles.len());
        for color in colors {
            let mut nodes: Vec<u32> = color.iter().flat_map(|&number| triangles[number as usize]).collect();
            let count = nodes.len();
            nodes.sort_unstable();
            nodes.dedup();
            assert_eq!(nodes.len(), count);
        }
    }
}
