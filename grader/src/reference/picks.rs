//! Trials of `pick_nearest_vertices`: no ray close to an edge, no vertex close to the radius, so that the answer is certain.

use nalgebra::{Matrix4, Orthographic3, Perspective3, Point3, Vector3, Vector4};

use super::elements::trial;
use super::random::Random;
use super::trial::{Input, Pick, Trial};

/// `pick_nearest_vertices`.
pub fn picks(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let mut trials = Vec::new();
    for _ in 0..400 {
        let (name, pick) = any(random);
        let found = answer(&pick);
        // A few that miss are enough.
        let misses = found.is_empty() && trials.iter().filter(|trial: &&Trial| trial.name == name).count() >= 4;
        if !misses && certain(&pick, &found) {
            let name = if found.is_empty() { "a miss or nobody near" } else { name };
            trials.push(trial(function, name, Input::Pick(pick), 1.0));
        }
        if trials.len() == 30 {
            break;
        }
    }
    trials
}

fn any(random: &mut Random) -> (&'static str, Pick) {
    let size = random.size();
    let (V, F) = cube(random, size);
    let away = random.vector(-1.0..1.0).normalize() * (random.number(4.0..8.0) * size);
    let eye = Point3::from(V[0] + away).cast::<f32>();
    let view = Matrix4::look_at_rh(&eye, &Point3::from(V[0]).cast::<f32>(), &random.vector(-1.0..1.0).cast::<f32>());
    let (width, height) = (random.number(300.0..900.0).round(), random.number(300.0..900.0).round());
    let (aspect, size32) = ((width / height) as f32, size as f32);
    let (name, proj) = if random.below(2) == 0 {
        ("seen in perspective", Perspective3::new(aspect, 0.8, 0.5 * size32, 50.0 * size32).to_homogeneous())
    } else {
        let (x, y) = (2.5 * size32 * aspect, 2.5 * size32);
        ("seen in parallel", Orthographic3::new(-x, x, -y, y, 0.1 * size32, 30.0 * size32).to_homogeneous())
    };
    let corner = [random.number(0.0..200.0).round(), random.number(0.0..200.0).round()];
    let viewport = Vector4::new(corner[0], corner[1], width, height).cast::<f32>();
    let win = Vector3::new(
        corner[0] + width * random.number(0.3..0.7),
        corner[1] + height * random.number(0.3..0.7),
        random.number(0.0..1.0),
    );
    let radius = random.number(0.3..3.0) * size;
    (name, Pick { win, view, proj, viewport, V, F, radius })
}

/// A crooked box of 12 triangles about the first vertex, which belongs to none.
fn cube(random: &mut Random, size: f64) -> (Vec<Vector3<f64>>, Vec<[usize; 3]>) {
    let (middle, turn) = (random.vector(-1.0..1.0) * size, random.rotation());
    let mut V = vec![middle];
    for k in 0..8 {
        let corner = Vector3::new((k % 2) as f64, (k / 2 % 2) as f64, (k / 4) as f64) * 2.0 - Vector3::repeat(1.0);
        V.push(middle + turn * (corner + random.vector(-0.2..0.2)) * size);
    }
    let sides = [[1, 2, 4, 3], [5, 6, 8, 7], [1, 2, 6, 5], [3, 4, 8, 7], [1, 3, 7, 5], [2, 4, 8, 6]];
    let triangles: Vec<_> = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let order = random.order(triangles.len());
    (V, order.into_iter().map(|k| triangles[k]).collect())
}

fn answer(pick: &Pick) -> Vec<usize> {
    let Pick { win, view, proj, viewport, V, F, radius } = pick;
    finite_elements_3d::pick_nearest_vertices(win, view, proj, viewport, V, F, *radius)
}

/// Returns true if the answer stays the same if the pixel moves a little and the radius changes a little.
fn certain(pick: &Pick, found: &[usize]) -> bool {
    let moves =
        [(0.5, 0.0, 1.0), (-0.5, 0.0, 1.0), (0.0, 0.5, 1.0), (0.0, -0.5, 1.0), (0.0, 0.0, 1.01), (0.0, 0.0, 0.99)];
    moves.iter().all(|&(x, y, factor)| {
        let moved = Pick { win: pick.win + Vector3::new(x, y, 0.0), radius: pick.radius * factor, ..pick.clone() };
        answer(&moved) == found
    })
}
