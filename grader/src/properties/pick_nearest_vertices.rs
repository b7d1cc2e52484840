//! To do: the vertices near the point of the surface under the mouse. Read include-docs/pick_nearest_vertices.md.

use nalgebra::{Matrix4, Orthographic3, Perspective3, Point3, Rotation3, Vector3, Vector4};

use super::outcome::{Outcome, holds, with_input};
use super::random::{for_all, vector};
use super::{Check, Course};
use crate::implementation::Answer;

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_pixel_over_a_corner_picks_that_corner,
    the_first_hit_counts_and_not_the_back_of_the_body,
    all_vertices_within_the_radius_are_returned_in_ascending_order,
    a_pixel_beside_the_body_picks_no_vertex,
    vertices_behind_the_camera_are_not_picked,
    vertices_in_front_of_the_near_plane_are_not_picked,
    depth_of_the_pixel_does_not_matter,
    the_window_may_lie_anywhere,
    triangles_are_hit_from_either_side,
    no_ray_slips_through_between_two_triangles,
    just_outside_an_edge_is_a_miss,
    a_triangle_seen_edge_on_is_not_hit,
    a_sphere_is_hit_where_geometry_says,
];

/// A camera on the z axis at (0, 0, 5) that looks at the origin, in a window of 800 × 600.
struct Camera {
    view: Matrix4<f32>,
    proj: Matrix4<f32>,
    viewport: Vector4<f32>,
}

impl Camera {
    fn perspective() -> Self {
        let view = Matrix4::look_at_rh(&Point3::new(0.0, 0.0, 5.0), &Point3::origin(), &Vector3::y());
        let proj = Perspective3::new(800.0 / 600.0, 0.9, 0.1, 100.0).to_homogeneous();
        Self { view, proj, viewport: Vector4::new(0.0, 0.0, 800.0, 600.0) }
    }

    /// 4 by 3 metres, one metre for 200 pixels, exact in binary numbers.
    fn parallel() -> Self {
        let view = Matrix4::new_translation(&Vector3::new(0.0, 0.0, -4.0));
        let proj = Orthographic3::new(-2.0, 2.0, -1.5, 1.5, 0.0, 8.0).to_homogeneous();
        Self { view, proj, viewport: Vector4::new(0.0, 0.0, 800.0, 600.0) }
    }

    /// The pixel that shows a point, from the lower left.
    fn pixel(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let clip = self.proj.cast::<f64>() * self.view.cast::<f64>() * point.push(1.0);
        let (x, y) = (clip.x / clip.w, clip.y / clip.w);
        let [left, bottom, width, height] = self.viewport.map(f64::from).into();
        Vector3::new(left + (x + 1.0) / 2.0 * width, bottom + (y + 1.0) / 2.0 * height, 0.0)
    }

    fn pick(
        &self,
        course: &Course,
        win: &Vector3<f64>,
        V: &[Vector3<f64>],
        F: &[[usize; 3]],
        radius: f64,
    ) -> Answer<Vec<usize>> {
        course.subject.pick_nearest_vertices(win, &self.view, &self.proj, &self.viewport, V, F, radius)
    }
}

/// The box from −1 to 1, two triangles a side, vertex numbers x + 2y + 4z.
fn cube() -> (Vec<Vector3<f64>>, Vec<[usize; 3]>) {
    let coordinate = |bit: usize| 2.0 * bit as f64 - 1.0;
    let V = (0..8).map(|k| Vector3::new(coordinate(k % 2), coordinate(k / 2 % 2), coordinate(k / 4))).collect();
    let sides = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    (V, sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

fn a_pixel_over_a_corner_picks_that_corner(course: &Course) -> Outcome {
    let (V, F) = cube();
    for camera in [Camera::perspective(), Camera::parallel()] {
        for corner in [4, 5, 6, 7] {
            let win = camera.pixel(&(V[corner] * 0.999));
            holds("win counts from the lower left", camera.pick(course, &win, &V, &F, 0.1)? == [corner])?;
        }
    }
    Ok(())
}

fn the_first_hit_counts_and_not_the_back_of_the_body(course: &Course) -> Outcome {
    let (V, F) = cube();
    let reversed: Vec<_> = F.iter().rev().copied().collect();
    for camera in [Camera::perspective(), Camera::parallel()] {
        for (F, win) in [(&F, camera.pixel(&Vector3::z())), (&reversed, camera.pixel(&Vector3::z()))] {
            // The middle of the front is sqrt 2 from its corners and sqrt 6 from those behind.
            holds("the front of the box is hit", camera.pick(course, &win, &V, F, 1.5)? == [4, 5, 6, 7])?;
        }
    }
    Ok(())
}

fn all_vertices_within_the_radius_are_returned_in_ascending_order(course: &Course) -> Outcome {
    let (mut V, F) = cube();
    // Vertices of no triangle count too, inside the body and in front of it.
    V.extend([Vector3::new(0.0, 0.0, 0.5), Vector3::new(0.0, 0.0, 1.4), Vector3::new(0.0, 0.0, 0.4)]);
    let camera = Camera::perspective();
    let win = camera.pixel(&Vector3::z());
    let all: Vec<usize> = (0..11).collect();
    for (radius, expected) in
        [(0.3, &[][..]), (0.55, &[8, 9]), (0.65, &[8, 9, 10]), (1.5, &[4, 5, 6, 7, 8, 9, 10]), (9.0, &all)]
    {
        let is_right = camera.pick(course, &win, &V, &F, radius)? == expected;
        let rule = "all vertices within the radius of the hit point, in ascending order, and no others";
        with_input(&format!("hit point (0, 0, 1), radius {radius} m"), holds(rule, is_right))?;
    }
    Ok(())
}

fn a_pixel_beside_the_body_picks_no_vertex(course: &Course) -> Outcome {
    let (V, F) = cube();
    for camera in [Camera::perspective(), Camera::parallel()] {
        for beside in [Vector3::new(1.4, 0.0, 1.0), Vector3::new(0.0, -1.4, 1.0), Vector3::new(1.1, 1.1, 1.0)] {
            holds("no hit, no vertices", camera.pick(course, &camera.pixel(&beside), &V, &F, 100.0)?.is_empty())?;
        }
        holds(
            "no surface, no vertices",
            camera.pick(course, &camera.pixel(&Vector3::zeros()), &V, &[], 100.0)?.is_empty(),
        )?;
    }
    Ok(())
}

fn vertices_behind_the_camera_are_not_picked(course: &Course) -> Outcome {
    let (V, F) = cube();
    let behind: Vec<_> = V.iter().map(|v| v + Vector3::z() * 10.0).collect();
    let camera = Camera::perspective();
    let win = camera.pixel(&Vector3::zeros());
    holds("the box is behind the eye", camera.pick(course, &win, &behind, &F, 100.0)?.is_empty())?;
    let both: Vec<_> = behind.iter().chain(&V).copied().collect();
    let faces: Vec<_> = F.iter().copied().chain(F.iter().map(|face| face.map(|vertex| vertex + 8))).collect();
    holds("the box in front of the eye is hit", camera.pick(course, &win, &both, &faces, 1.5)? == [12, 13, 14, 15])
}

fn vertices_in_front_of_the_near_plane_are_not_picked(course: &Course) -> Outcome {
    let (mut V, mut F) = cube();
    F.push([8, 9, 10]);
    // The nearest depth that is shown is at z = 4.9 in perspective and at z = 4 in parallel projection.
    for (camera, z) in [(Camera::perspective(), 4.91), (Camera::parallel(), 4.1)] {
        V.truncate(8);
        V.extend([Vector3::new(-0.1, -0.1, z), Vector3::new(0.1, -0.1, z), Vector3::new(0.0, 0.1, z)]);
        let found = camera.pick(course, &camera.pixel(&Vector3::zeros()), &V, &F, 1.5)?;
        holds("the line of sight begins at the nearest depth that is shown", found == [4, 5, 6, 7])?;
    }
    Ok(())
}

fn depth_of_the_pixel_does_not_matter(course: &Course) -> Outcome {
    let (V, F) = cube();
    let camera = Camera::perspective();
    for z in [0.0, 0.5, 1.0, -7.0, f64::NAN] {
        let win = Vector3::new(400.0, 300.0, z);
        holds("win's z is not used", camera.pick(course, &win, &V, &F, 1.5)? == [4, 5, 6, 7])?;
    }
    Ok(())
}

fn the_window_may_lie_anywhere(course: &Course) -> Outcome {
    let (V, F) = cube();
    for viewport in [Vector4::new(100.0, 50.0, 800.0, 600.0), Vector4::new(-30.0, 7.0, 320.0, 900.0)] {
        let camera = Camera { viewport, ..Camera::perspective() };
        for corner in [4, 5, 6, 7] {
            let win = camera.pixel(&(V[corner] * 0.999));
            holds("viewport = (x, y, width, height)", camera.pick(course, &win, &V, &F, 0.1)? == [corner])?;
        }
    }
    Ok(())
}

fn triangles_are_hit_from_either_side(course: &Course) -> Outcome {
    let V = [Vector3::new(-1.0, -1.0, 0.0), Vector3::new(1.0, -1.0, 0.0), Vector3::new(0.0, 1.0, 0.0)];
    let camera = Camera::perspective();
    let win = camera.pixel(&Vector3::new(0.1, -0.2, 0.0));
    for triangle in [[0, 1, 2], [0, 2, 1], [2, 1, 0]] {
        holds("either side counts", camera.pick(course, &win, &V, &[triangle], 5.0)? == [0, 1, 2])?;
    }
    Ok(())
}

fn no_ray_slips_through_between_two_triangles(course: &Course) -> Outcome {
    // Front of the box: the diagonal, the edges and the corners, each under pixels that show them exactly.
    let (V, F) = cube();
    let camera = Camera::parallel();
    for k in 0..=20 {
        let along = 200.0 + 20.0 * f64::from(k);
        let (x, y) = (along, along - 100.0);
        for win in [Vector3::new(x, y, 0.0), Vector3::new(x, 700.0 - x, 0.0), Vector3::new(x, 300.0, 0.0)] {
            let found = camera.pick(course, &win, &V, &F[2..4], 3.0)?;
            holds("the seam between two triangles is hit", [4, 5, 6, 7].iter().all(|vertex| found.contains(vertex)))?;
        }
    }
    for corners in
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]]
    {
        let triangle = [V[4], V[5], V[6]];
        let point: Vector3<f64> = (0..3).map(|k| triangle[k] * corners[k]).sum();
        let found = camera.pick(course, &camera.pixel(&point), &V, &[[4, 5, 6]], 9.0)?;
        holds("corners and edges belong to the triangle", found.len() == 8)?;
    }
    Ok(())
}

fn just_outside_an_edge_is_a_miss(course: &Course) -> Outcome {
    let (V, _) = cube();
    let camera = Camera::parallel();
    // The triangle (−1, −1), (1, −1), (−1, 1) at 200 pixels a metre: just beyond each of its three edges.
    for win in [[300.0, 99.9], [199.9, 200.0], [400.1, 300.1]] {
        let found = camera.pick(course, &Vector3::new(win[0], win[1], 0.0), &V, &[[4, 5, 6]], 9.0)?;
        holds("a pixel just beside a triangle misses it", found.is_empty())?;
    }
    Ok(())
}

fn a_triangle_seen_edge_on_is_not_hit(course: &Course) -> Outcome {
    let V = [Vector3::new(0.0, -1.0, 1.0), Vector3::new(0.0, 1.0, 1.0), Vector3::new(0.0, 0.0, -1.0)];
    let camera = Camera::parallel();
    let found = camera.pick(course, &Vector3::new(400.0, 300.0, 0.0), &V, &[[0, 1, 2]], 9.0)?;
    holds("a ray in the triangle's plane gives no garbage", found.is_empty() || found == [0, 1, 2])?;
    let (box_V, box_F) = cube();
    let V: Vec<_> = V.iter().chain(&box_V).copied().collect();
    let F: Vec<_> = box_F.iter().map(|f| f.map(|vertex| vertex + 3)).chain([[0, 1, 2]]).collect();
    let found = camera.pick(course, &Vector3::new(400.0, 300.0, 0.0), &V, &F, 1.6)?;
    holds("and does not hide the others", [7, 8, 9, 10].iter().all(|vertex| found.contains(vertex)))
}

fn a_sphere_is_hit_where_geometry_says(course: &Course) -> Outcome {
    let sphere = Sphere::new(2.0, 80);
    for_all(course.seed, (vector(-3.0..3.0), vector(-1.0..1.0)), |(turn, aim)| {
        // Seen from any side: the point under a pixel is the near intersection of the pixel's ray with the sphere.
        let turn = Rotation3::from_scaled_axis(turn);
        let eye = turn * Vector3::new(0.0, 0.0, 9.0);
        let up = turn * Vector3::y();
        let view = Matrix4::look_at_rh(&Point3::from(eye.cast()), &Point3::origin(), &up.cast());
        let camera = Camera { view, ..Camera::perspective() };
        let target = turn * Vector3::new(aim.x, aim.y, 0.0);
        let direction = (target - eye).normalize();
        let towards = eye.dot(&direction);
        let distance = -towards - (towards * towards - eye.norm_squared() + 4.0).sqrt();
        let point = eye + direction * distance;

        let found = camera.pick(course, &camera.pixel(&target), &sphere.V, &sphere.F, 0.5)?;
        // The facets lie up to some millimetres below the sphere.
        let within =
            |radius: f64| (0..sphere.V.len()).filter(|&k| (sphere.V[k] - point).norm() <= radius).collect::<Vec<_>>();
        holds(
            "vertices clearly within the radius are picked",
            within(0.49).iter().all(|vertex| found.contains(vertex)),
        )?;
        let is_near = |&k: &usize| sphere.V.get(k).is_some_and(|vertex| (vertex - point).norm() <= 0.51);
        holds("vertices clearly beyond the radius are not", found.iter().all(is_near))?;
        holds("some are", !found.is_empty() && found.is_sorted())
    })
}

/// A sphere of facets around the origin.
struct Sphere {
    V: Vec<Vector3<f64>>,
    F: Vec<[usize; 3]>,
}

impl Sphere {
    fn new(radius: f64, meridians: usize) -> Self {
        let rings = meridians / 2;
        let angle = |k: usize, of: usize| k as f64 / of as f64 * std::f64::consts::PI;
        let vertex = |ring: usize, k: usize| {
            let (latitude, longitude) = (angle(ring, rings), 2.0 * angle(k, meridians));
            Vector3::new(latitude.sin() * longitude.cos(), latitude.cos(), latitude.sin() * longitude.sin()) * radius
        };
        let places = (0..=rings).flat_map(|ring| (0..meridians).map(move |k| (ring, k)));
        let index = |ring: usize, k: usize| ring * meridians + k % meridians;
        let quads = places.clone().filter(|&(ring, _)| ring < rings);
        let facets = |(ring, k)| {
            let (a, b, c, d) = (index(ring, k), index(ring, k + 1), index(ring + 1, k), index(ring + 1, k + 1));
            [[a, b, c], [b, d, c]]
        };
        Self { V: places.map(|(ring, k)| vertex(ring, k)).collect(), F: quads.flat_map(facets).collect() }
    }
}
