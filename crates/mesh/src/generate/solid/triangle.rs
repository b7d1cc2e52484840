//! One triangle and a point or a way: solid angle, crossing, closest point.

use nalgebra::Vector3;

/// Solid angle of a triangle from a point, van Oosterom and Strackee, The Solid Angle of a Plane Triangle (1983); positive from behind.
pub fn solid_angle(corners: &[Vector3<f64>; 3], point: &Vector3<f64>) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - point);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let below = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    2.0 * a.dot(&b.cross(&c)).atan2(below)
}

/// Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection (1997).
pub fn crossing([a, b, c]: &[Vector3<f64>; 3], from: &Vector3<f64>, way: &Vector3<f64>) -> Option<f64> {
    let (u, v) = (b - a, c - a);
    let normal = way.cross(&v);
    let determinant = u.dot(&normal);
    if determinant == 0.0 {
        return None;
    }
    let off = from - a;
    let across = off.cross(&u);
    let (x, y) = (off.dot(&normal) / determinant, way.dot(&across) / determinant);
    let at = v.dot(&across) / determinant;
    // A hair beyond the edges: a way through the edge of two triangles must not slip between them.
    let hair = 1e-10;
    (x >= -hair && y >= -hair && x + y <= 1.0 + hair && (0.0..=1.0).contains(&at)).then_some(at)
}

/// The point of a triangle closest to a point: Ericson, Real-Time Collision Detection (2005), section 5.1.5.
pub fn closest_of_triangle(&[a, b, c]: &[Vector3<f64>; 3], point: &Vector3<f64>) -> Vector3<f64> {
    let (u, v) = (b - a, c - a);
    let [from_a, from_b, from_c] = [a, b, c].map(|corner| point - corner);
    let [ua, va, ub, vb, uc, vc] =
        [u.dot(&from_a), v.dot(&from_a), u.dot(&from_b), v.dot(&from_b), u.dot(&from_c), v.dot(&from_c)];
    let [at_a, at_b, at_c] = [ub * vc - uc * vb, uc * va - ua * vc, ua * vb - ub * va];
    if ua <= 0.0 && va <= 0.0 {
        a
    } else if ub >= 0.0 && vb <= ub {
        b
    } else if vc >= 0.0 && uc <= vc {
        c
    } else if at_c <= 0.0 && ua >= 0.0 && ub <= 0.0 {
        a + u * (ua / (ua - ub))
    } else if at_b <= 0.0 && va >= 0.0 && vc <= 0.0 {
        a + v * (va / (va - vc))
    } else if at_a <= 0.0 && vb - ub >= 0.0 && uc - vc >= 0.0 {
        b + (c - b) * ((vb - ub) / ((vb - ub) + (uc - vc)))
    } else {
        let sum = at_a + at_b + at_c;
        if sum > 0.0 { a + u * (at_b / sum) + v * (at_c / sum) } else { a }
    }
}
