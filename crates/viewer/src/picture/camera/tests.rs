use nalgebra::Vector4;

use super::*;

const SIZE: Vec2 = Vec2::new(1280.0, 800.0);

fn body() -> Bounds {
    Bounds { low: Vec3::new(-1.0, 0.0, -0.5), high: Vec3::new(3.0, 1.0, 0.5) }
}

/// Pixels from the upper left at which the graphics card draws `point`.
fn drawn_at(camera: &Camera, point: Vec3) -> Vec2 {
    let clip = camera.transformation() * point.extend(1.0);
    let (x, y) = (clip.x / clip.w, clip.y / clip.w);
    Vec2::new((1.0 + x) / 2.0 * camera.size.x, (1.0 - y) / 2.0 * camera.size.y)
}

/// Pixels from the lower left of a point, by the click's own matrices and OpenGL's conventions.
fn projected(click: &Click, point: Vec3) -> Vector3<f32> {
    let clip = click.proj * click.view * Vector4::new(point.x, point.y, point.z, 1.0);
    let ndc = clip.xyz() / clip.w;
    let [x, y, width, height] = click.viewport.into();
    Vector3::new(x + width * (ndc.x + 1.0) / 2.0, y + height * (ndc.y + 1.0) / 2.0, (ndc.z + 1.0) / 2.0)
}

fn unprojected(click: &Click, win: Vector3<f32>) -> Vec3 {
    let [x, y, width, height] = click.viewport.into();
    let ndc = Vector4::new(2.0 * (win.x - x) / width - 1.0, 2.0 * (win.y - y) / height - 1.0, 2.0 * win.z - 1.0, 1.0);
    let world = (click.proj * click.view).try_inverse().unwrap() * ndc;
    Vec3::new(world.x, world.y, world.z) / world.w
}

#[test]
fn the_whole_body_is_in_the_uncovered_part_of_the_picture() {
    for up in [Vec3::Y, Vec3::Z, Vec3::X, Vec3::new(0.2, 1.0, -0.3)] {
        for (size, covered) in [(SIZE, 0.0), (SIZE, 340.0), (Vec2::new(400.0, 900.0), 0.0)] {
            let camera = Camera::framing(View::Orbit, &body(), up, size, covered);
            for corner in body().corners() {
                let at = drawn_at(&camera, corner);
                assert!(at.x > covered && at.x < size.x && at.y > 0.0 && at.y < size.y, "{up} {size} {at}");
            }
        }
    }
}

#[test]
fn the_body_fills_most_of_the_uncovered_width() {
    let camera = Camera::framing(View::Orbit, &body(), Vec3::Y, SIZE, 340.0);
    let across: Vec<f32> = body().corners().map(|c| drawn_at(&camera, c).x).to_vec();
    let width = across.iter().copied().fold(0.0, f32::max) - across.iter().copied().fold(f32::MAX, f32::min);
    assert!(width > 0.6 * (SIZE.x - 340.0), "{width} pixels");
}

#[test]
fn up_is_up_and_the_first_view_is_from_the_front() {
    for up in [Vec3::Y, Vec3::Z] {
        let camera = Camera::framing(View::Orbit, &body(), up, SIZE, 0.0);
        let centre = body().centre();
        assert!(drawn_at(&camera, centre + up * 0.1).y < drawn_at(&camera, centre).y);
        assert!(drawn_at(&camera, centre + Vec3::X * 0.1).x > drawn_at(&camera, centre).x);
    }
}

#[test]
fn a_click_projects_a_point_to_where_it_is_drawn_and_back() {
    let mut camera = Camera::framing(View::Orbit, &body(), Vec3::Y, SIZE, 340.0);
    camera.orbit(Vec2::new(70.0, 30.0));
    for corner in body().corners() {
        let at = drawn_at(&camera, corner);
        let click = camera.click(at);
        let projected = projected(&click, corner);
        assert!((f64::from(projected.x) - click.win.x).abs() < 0.01, "{projected} {}", click.win);
        assert!((f64::from(projected.y) - click.win.y).abs() < 0.01, "{projected} {}", click.win);
        assert!((unprojected(&click, projected) - corner).length() < 1e-3);
    }
}

#[test]
fn the_ray_through_a_pixel_meets_the_point_that_is_drawn_there() {
    let camera = Camera::framing(View::Orbit, &body(), Vec3::Z, SIZE, 340.0);
    for corner in body().corners() {
        let cursor = drawn_at(&camera, corner);
        let (origin, ray) = camera.ray(cursor);
        assert!((corner - origin).normalize().dot(ray) > 1.0 - 1e-6);
        assert!((camera.on_plane(cursor, corner) - corner).length() < 1e-3);
    }
}

#[test]
fn panning_moves_the_body_with_the_mouse() {
    let mut camera = Camera::framing(View::Orbit, &body(), Vec3::Y, SIZE, 0.0);
    let before = drawn_at(&camera, body().centre());
    camera.pan(Vec2::new(40.0, 25.0));
    let after = drawn_at(&camera, body().centre());
    assert!((after - before - Vec2::new(40.0, 25.0)).length() < 0.5, "{before} {after}");
}

#[test]
fn zooming_and_orbiting_are_bounded() {
    let mut camera = Camera::framing(View::Orbit, &body(), Vec3::Y, SIZE, 0.0);
    for _ in 0..1000 {
        camera.zoom(3.0, SIZE / 2.0);
        camera.orbit(Vec2::new(0.0, 100.0));
    }
    assert!(camera.distance > 0.0 && camera.direction().y < 1.0);
    for _ in 0..1000 {
        camera.zoom(-3.0, SIZE / 2.0);
    }
    assert!(camera.distance.is_finite() && camera.transformation().is_finite());
}

#[test]
fn a_body_without_extent_gives_finite_matrices() {
    let point = Bounds { low: Vec3::ONE, high: Vec3::ONE };
    let camera = Camera::framing(View::Orbit, &point, Vec3::ZERO, SIZE, 0.0);
    assert!(camera.transformation().is_finite());
}

/// The bounding box of a flat body.
fn flat() -> Bounds {
    Bounds { low: Vec3::new(-1.0, 0.0, 0.0), high: Vec3::new(3.0, 1.0, 0.0) }
}

#[test]
fn a_flat_body_is_seen_from_the_front_in_its_true_proportions() {
    for up in [Vec3::Y, Vec3::Z, Vec3::X, -Vec3::Y] {
        let camera = Camera::framing(View::Front, &flat(), up, SIZE, 340.0);
        let in_picture = if up == Vec3::Z { Vec3::Y } else { up };
        let at = |point: Vec3| drawn_at(&camera, point);
        let centre = flat().centre();
        let (above, right) = (at(centre + in_picture * 0.1) - at(centre), at(centre + in_picture.cross(Vec3::Z) * 0.1));
        assert!(above.y < 0.0 && above.x.abs() < 1e-2, "{up} {above}");
        assert!(((right - at(centre)).x + above.y).abs() < 1e-2, "both lengths are the same");
        for corner in flat().corners() {
            let at = at(corner);
            assert!(at.x > 340.0 && at.x < SIZE.x && at.y > 0.0 && at.y < SIZE.y, "{up} {at}");
        }
        let clip = camera.transformation() * centre.extend(1.0);
        assert!(clip.w == 1.0 && clip.z > 0.0 && clip.z < 1.0, "the graphics card draws it: {clip}");
    }
}

#[test]
fn a_view_from_the_front_does_not_turn() {
    let mut camera = Camera::framing(View::Front, &flat(), Vec3::Y, SIZE, 0.0);
    let before = camera.transformation();
    camera.orbit(Vec2::new(80.0, 30.0));
    assert_eq!(camera.transformation(), before);
}

#[test]
fn the_point_under_the_cursor_stays_there_in_a_zoom_from_the_front() {
    let mut camera = Camera::framing(View::Front, &flat(), Vec3::Y, SIZE, 340.0);
    let cursor = Vec2::new(900.0, 250.0);
    let point = camera.on_plane(cursor, Vec3::ZERO);
    let distance = camera.distance;
    camera.zoom(3.0, cursor);
    assert!(camera.distance < 0.8 * distance);
    assert!((drawn_at(&camera, point) - cursor).length() < 0.1);
}

#[test]
fn a_click_from_the_front_projects_a_point_to_where_it_is_drawn_and_back() {
    let mut camera = Camera::framing(View::Front, &flat(), Vec3::Y, SIZE, 340.0);
    camera.pan(Vec2::new(31.0, -12.0));
    for corner in flat().corners() {
        let at = drawn_at(&camera, corner);
        let click = camera.click(at);
        let projected = projected(&click, corner);
        assert!((f64::from(projected.x) - click.win.x).abs() < 0.01, "{projected} {}", click.win);
        assert!((f64::from(projected.y) - click.win.y).abs() < 0.01, "{projected} {}", click.win);
        assert!((unprojected(&click, projected) - corner).length() < 1e-3);
        assert!((camera.on_plane(at, corner) - corner).length() < 1e-3);
    }
}
