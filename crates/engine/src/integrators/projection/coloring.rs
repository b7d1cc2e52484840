//! Colours of constraints: constraints of one colour have no common node, so that their corrections are independent.

use std::ops::Range;

/// The constraints in the order of their colours, and the range of each colour in that order.
pub struct Coloring {
    /// Numbers of the constraints, colour after colour; ascending within a colour.
    pub order: Vec<u32>,
    /// The part of `order` that has each colour.
    pub colors: Vec<Range<usize>>,
}

/// Gives each constraint the first colour that none of its nodes has yet: the greedy colouring of Fratarcangeli, Tibaldo and Pellacini,
/// Vivace: a practical Gauss–Seidel method for stable soft body dynamics (2016), without its random choices.
pub fn color<const N: usize>(nodes: usize, constraints: &[[u32; N]]) -> Coloring {
    let mut of_node: Vec<Vec<u32>> = vec![Vec::new(); nodes];
    let mut of_color: Vec<Vec<u32>> = Vec::new();
    // The constraint that has last excluded each colour.
    let mut excluded_by: Vec<usize> = Vec::new();
    for (number, constraint) in constraints.iter().enumerate() {
        for &node in constraint {
            of_node[node as usize].iter().for_each(|&color| excluded_by[color as usize] = number + 1);
        }
        let color = excluded_by.iter().position(|&by| by != number + 1).unwrap_or(excluded_by.len());
        if color == excluded_by.len() {
            excluded_by.push(0);
            of_color.push(Vec::new());
        }
        of_color[color].push(number as u32);
        constraint.iter().for_each(|&node| of_node[node as usize].push(color as u32));
    }
    let mut end = 0;
    let range = |constraints: &Vec<u32>| {
        end += constraints.len();
        end - constraints.len()..end
    };
    Coloring { colors: of_color.iter().map(range).collect(), order: of_color.concat() }
}

#[cfg(test)]
mod tests {
    use super::color;

    #[test]
    fn constraints_of_one_colour_share_no_node_and_each_has_one_colour() {
        // Triangles of a strip, each pair of neighbours with two common nodes, and one far away.
        let mut triangles: Vec<[u32; 3]> = (0..40).map(|i| [i, i + 1, i + 2]).collect();
        triangles.push([60, 61, 62]);
        let coloring = color(63, &triangles);
        assert_eq!(coloring.colors.len(), 3);
        let mut seen = coloring.order.clone();
        seen.sort_unstable();
        assert!(seen.iter().enumerate().all(|(i, &number)| i == number as usize) && seen.len() == triangles.len());
        for range in coloring.colors {
            let mut nodes: Vec<u32> =
                coloring.order[range].iter().flat_map(|&number| triangles[number as usize]).collect();
            let count = nodes.len();
            nodes.sort_unstable();
            nodes.dedup();
            assert_eq!(nodes.len(), count);
        }
    }
}
