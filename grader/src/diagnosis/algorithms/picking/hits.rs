//! From the line of sight to the hits, and to the vertices near them.

use nalgebra::Vector4;

use super::{Among, From, Hit, Order, Point, Settings};
use crate::reference::trial::Pick;

/// Two points on the line of sight; `None` if there is none.
pub fn line(s: &Settings, pick: &Pick) -> Option<[Point; 2]> {
    let viewport = pick.viewport.cast::<f64>();
    let [x, y] = (s.place)(&pick.win, &viewport);
    let back = (s.back)(&pick.view.cast(), &pick.proj.cast())?;
    Some((s.depths)(pick.win.z).map(|depth| (s.divided)(back * Vector4::new(x, y, depth, 1.0))))
}

/// The vertices near the hits.
pub fn found(s: &Settings, pick: &Pick, [near, far]: [Point; 2]) -> Vec<usize> {
    let direction = far - near;
    let hits: Vec<_> = pick.F.iter().filter_map(|t| Some((hit(s, pick, &near, &direction, t)?, t))).collect();
    let along = |a: &&(f64, &[usize; 3]), b: &&(f64, &[usize; 3])| a.0.total_cmp(&b.0);
    let chosen: Vec<_> = match s.hit {
        Hit::First => hits.iter().min_by(along).into_iter().collect(),
        Hit::Last => hits.iter().max_by(along).into_iter().collect(),
        Hit::FirstInList => hits.first().into_iter().collect(),
        Hit::LastInList => hits.last().into_iter().collect(),
        Hit::All => hits.iter().collect(),
    };
    let nearest_to = |hit: Point, of: &mut dyn Iterator<Item = usize>| {
        let points = of.map(|vertex| pick.V[vertex]);
        points.min_by(|a, b| (a - hit).norm().total_cmp(&(b - hit).norm())).unwrap_or(hit)
    };
    let distance = |vertex: usize| {
        let to = |&&(t, triangle): &&(f64, &[usize; 3])| match s.from {
            From::Hit => (s.norm)(&(pick.V[vertex] - near - direction * t)),
            From::Centroid => (pick.V[vertex] - triangle.iter().map(|&i| pick.V[i]).sum::<Point>() / 3.0).norm(),
            From::Corner => (pick.V[vertex] - pick.V[triangle[0]]).norm(),
            From::NearestCorner => {
                (pick.V[vertex] - nearest_to(near + direction * t, &mut triangle.iter().copied())).norm()
            }
            From::NearestOnSurface => {
                let corners = &mut pick.F.iter().flatten().copied();
                (pick.V[vertex] - nearest_to(near + direction * t, corners)).norm()
            }
            From::NearestVertex => (pick.V[vertex] - nearest_to(near + direction * t, &mut (0..pick.V.len()))).norm(),
            From::Near => (pick.V[vertex] - near).norm(),
            From::Far => (pick.V[vertex] - far).norm(),
            From::Line => (pick.V[vertex] - near).cross(&direction.normalize()).norm(),
        };
        chosen.iter().map(to).fold(f64::INFINITY, f64::min)
    };
    let is_among = |vertex: &usize| match s.among {
        Among::All | Among::WithTriangles => true,
        Among::OfTriangles => pick.F.iter().any(|t| t.contains(vertex)),
        Among::OfTheTriangle => chosen.iter().any(|(_, t)| t.contains(vertex)),
    };
    let is_near = |vertex: &usize| !chosen.is_empty() && (s.near)(distance(*vertex), pick.radius);
    let mut found: Vec<usize> = (0..pick.V.len()).filter(is_among).filter(is_near).collect();
    if matches!(s.among, Among::WithTriangles) {
        let corners = pick.F.iter().filter(|t| t.iter().any(|corner| found.contains(corner))).flatten();
        found = found.iter().chain(corners).copied().collect();
        found.sort_unstable();
        found.dedup();
    }
    match s.order {
        Order::Ascending => {}
        Order::Descending => found.reverse(),
        Order::FirstAlone => found.truncate(1),
        Order::ByDistance | Order::NearestAlone => found.sort_by(|&a, &b| distance(a).total_cmp(&distance(b))),
    }
    if matches!(s.order, Order::NearestAlone) {
        found.truncate(1);
    }
    found
}

fn hit(s: &Settings, pick: &Pick, origin: &Point, direction: &Point, triangle: &[usize; 3]) -> Option<f64> {
    let [a, b, c] = triangle.map(|vertex| pick.V[vertex]);
    let (p, q) = (direction.cross(&(c - a)), (origin - a).cross(&(b - a)));
    let determinant = (b - a).dot(&p);
    let (u, v) = ((origin - a).dot(&p) / determinant, direction.dot(&q) / determinant);
    let t = (c - a).dot(&q) / determinant;
    let counts = (s.inside)(u, v) && (s.ahead)(t) && (s.side)((b - a).cross(&(c - a)).dot(direction));
    (counts && t.is_finite()).then_some(t)
}
