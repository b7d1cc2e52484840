//! Contours of a picture: marching squares, Lorensen and Cline, Marching Cubes (1987), in the plane.

use std::collections::HashMap;

use nalgebra::Vector2;

use super::Picture;

/// Corners of a cell and the ends of its edges, counter-clockwise from the lower left.
const CORNERS: [[isize; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

/// The curves along which the coverage is one half, in pixels from the lower left of the picture, with the inside to the left: outer curves run
/// counter-clockwise, those of holes clockwise. Between pixels the coverage is linear along the lines that join their centres; around the
/// picture it is zero. Where two inner pixels face each other across two outer ones, they are connected if the mean of the four is inside. No curve
/// touches itself or another.
///
/// # Errors
/// The number of crossings, if there are more than `most`.
pub fn contours(picture: &Picture, most: usize) -> Result<Vec<Vec<Vector2<f64>>>, usize> {
    let segments = segments(picture);
    if segments.len() > most {
        return Err(segments.len());
    }
    let mut next: HashMap<u64, u64> = segments.iter().copied().collect();
    let mut curves = Vec::new();
    for (start, _) in segments {
        let mut curve = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            curve.push(crossing(picture, at));
            at = to;
        }
        if !curve.is_empty() {
            curves.push(curve);
        }
    }
    Ok(curves)
}

/// The pieces of the contours within the cells between four pixels, each from one crossing to another.
fn segments(picture: &Picture) -> Vec<(u64, u64)> {
    let mut segments = Vec::new();
    for j in -1..picture.height as isize {
        let mut left = [false, picture.is_inside(-1, j), picture.is_inside(-1, j + 1)];
        for i in -1..picture.width as isize {
            let right = [picture.is_inside(i + 1, j), picture.is_inside(i + 1, j + 1)];
            let inside = [left[1], right[0], right[1], left[2]];
            if inside != [inside[0]; 4] {
                cross_cell(picture, [i, j], inside, &mut segments);
            }
            left = [false, right[0], right[1]];
        }
    }
    segments
}

fn cross_cell(picture: &Picture, [i, j]: [isize; 2], inside: [bool; 4], segments: &mut Vec<(u64, u64)>) {
    let leaves = |edge: usize| inside[edge] && !inside[(edge + 1) % 4];
    let enters = |edge: usize| !inside[edge] && inside[(edge + 1) % 4];
    let sum: u32 = CORNERS.iter().map(|[x, y]| u32::from(picture.at(i + x, j + y))).sum();
    let are_joined = sum > 2 * 255;
    for edge in (0..4).filter(|&edge| leaves(edge)) {
        // With two pieces, each goes around an outer corner if the inner ones are joined, and around an inner one otherwise.
        let turns = if are_joined { [1, 2, 3] } else { [3, 2, 1] };
        if let Some(end) = turns.map(|turn| (edge + turn) % 4).into_iter().find(|&end| enters(end)) {
            segments.push((key(picture, i, j, edge), key(picture, i, j, end)));
        }
    }
}

/// Number of the crossing on an edge of a cell: the pixel at its lower or left end, and its direction.
fn key(picture: &Picture, i: isize, j: isize, edge: usize) -> u64 {
    let (i, j, direction) = match edge {
        0 => (i, j, 0),
        1 => (i + 1, j, 1),
        2 => (i, j + 1, 0),
        _ => (i, j, 1),
    };
    2 * ((j + 1) as u64 * (picture.width as u64 + 2) + (i + 1) as u64) + direction
}

fn crossing(picture: &Picture, key: u64) -> Vector2<f64> {
    let (cell, direction) = (key / 2, (key % 2) as isize);
    let row = picture.width as u64 + 2;
    let (i, j) = ((cell % row) as isize - 1, (cell / row) as isize - 1);
    let (start, end) = (f64::from(picture.at(i, j)), f64::from(picture.at(i + 1 - direction, j + direction)));
    let share = (127.5 - start) / (end - start);
    // Centres of pixels are at halves.
    let place = Vector2::new(i as f64 + 0.5, j as f64 + 0.5);
    if direction == 0 { place + Vector2::new(share, 0.0) } else { place + Vector2::new(0.0, share) }
}
