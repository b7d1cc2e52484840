//! Mistakes that take one input for another: the right formula with a wrong argument.

mod parts;

use grader::implementation::Local;
use nalgebra::{DVector, Vector3};

use super::Candidate;
use crate::reference::REFERENCE;
use crate::reference::trial::{Elastic, Input, Mesh, Pick, Step};
use parts::{flattened, of_constants, off_by_one, one_less, still};

type Change = fn(&Input) -> Option<Input>;

/// Name, sentence and the changed input of a mistake.
const CHANGES: &[(&str, &str, Change)] = &[
    (
        "C and D swapped",
        "The two constants of the material have changed places. Which one multiplies the volume term?",
        swapped,
    ),
    (
        "rest for deformed",
        "The answer is that of a body at rest. From which positions is the deformation gradient computed?",
        rest_for_deformed,
    ),
    (
        "deformed for rest",
        "Undeformed positions are taken from the deformed body. Which of the two do the shape functions belong to?",
        deformed_for_rest,
    ),
    (
        "rest and deformed swapped",
        "Deformed and undeformed positions have changed places. Which of the two is q?",
        rest_and_deformed_swapped,
    ),
    (
        "local for global indices",
        "Vertices 0 to 3 are taken, whatever the element. What do the entries of element count?",
        local,
    ),
    (
        "local for global indices in q",
        "The first four vertices of q are taken, whatever the element. What do the entries of element count?",
        local_in_q,
    ),
    (
        "factor 3 left out in q",
        "The wrong entries of the velocities are read: where does a vertex's x stand?",
        factor_3_left_out,
    ),
    (
        "off by one",
        "The neighbours of the element's vertices are taken: do indices count from 0 or from 1?",
        off_by_one,
    ),
    ("off by one", "The neighbours of the element's vertices are taken: do indices count from 0 or from 1?", one_less),
    ("first vertex left out", parts::LEFT_OUT, |input| still(input, |k| k < 3)),
    ("last vertex left out", parts::LEFT_OUT, |input| still(input, |k| k >= 9)),
    ("only the first vertex", parts::LEFT_OUT, |input| still(input, |k| k >= 3)),
    ("z left out", parts::LEFT_OUT, |input| flattened(input, [1.0, 1.0, 0.0])),
    ("only x", parts::LEFT_OUT, |input| flattened(input, [1.0, 0.0, 0.0])),
    ("missing the term with C", "The constant C has no effect. What does it weigh?", |input| {
        of_constants(input, |C, _| *C = 0.0)
    }),
    ("missing the term with D", "The constant D has no effect. What does it weigh?", |input| {
        of_constants(input, |_, D| *D = 0.0)
    }),
    ("missing C", "The constant C has no effect, as if it were 1. What are the units of the answer?", |input| {
        of_constants(input, |C, _| *C = 1.0)
    }),
    ("missing D", "The constant D has no effect, as if it were 1. What are the units of the answer?", |input| {
        of_constants(input, |_, D| *D = 1.0)
    }),
    ("C for D", "One constant stands in both places.", |input| of_constants(input, |C, D| *D = *C)),
    ("D for C", "One constant stands in both places.", |input| of_constants(input, |C, D| *C = *D)),
    ("C scaled by 0.5", "The constant C counts half.", |input| of_constants(input, |C, _| *C *= 0.5)),
    ("C scaled by 2", "The constant C counts twice.", |input| of_constants(input, |C, _| *C *= 2.0)),
    ("D scaled by 0.5", "The constant D counts half.", |input| of_constants(input, |_, D| *D *= 0.5)),
    ("D scaled by 2", "The constant D counts twice.", |input| of_constants(input, |_, D| *D *= 2.0)),
    ("missing rest length", "The spring pulls as if its rest length were zero. Where does l0 enter?", no_rest_length),
    ("F transposed", "The deformation gradient is read column by column. What are its rows?", transposed_F),
    (
        "missing dt",
        "The force changes the velocity by as much in a short step as in a long one. What are the units of each term?",
        missing_dt,
    ),
    (
        "dt for dt²",
        "The stiffness enters with the wrong power of dt. What are the units of each term?",
        dt_for_dt_squared,
    ),
    (
        "stiffness with the wrong sign",
        "The stiffness is added with the wrong sign. Is K the derivative of the force or of the gradient?",
        anti_stiffness,
    ),
    (
        "force with the wrong sign",
        "The force acts the wrong way. Is f the gradient of the energy or its opposite?",
        anti_force,
    ),
    (
        "stiffness left out",
        "The step is as if there were no stiffness. Which matrix is to be solved with?",
        no_stiffness,
    ),
    (
        "damping left out",
        "The force is not asked for at the present velocity. Which two vectors does it take?",
        no_damping,
    ),
    ("a single step", "Only one direction is taken. When does Newton's method end?", single_step),
    ("upside down", "The picture is upside down. From which corner of the window are pixels counted?", upside_down),
    (
        "corner of the viewport left out",
        "The corner of the viewport is taken to be at zero. What are its four numbers?",
        no_corner,
    ),
    (
        "radius for its square",
        "A distance is compared with the square of another. Which two lengths are to be compared?",
        squared_radius,
    ),
];

/// All of them, and the wrong orders of an element's vertices.
pub fn candidates<'a>() -> Vec<Candidate<'a>> {
    let changes = CHANGES.iter().map(|&(name, sentence, change)| {
        Candidate::new(name, sentence, move |trial, _| {
            let input = change(&trial.input)?;
            crate::reference::trial::Trial { input, ..trial.clone() }.run(&Local(REFERENCE)).ok()
        })
    });
    changes.chain(orders()).collect()
}

/// The 23 wrong orders.
fn orders<'a>() -> impl Iterator<Item = Candidate<'a>> {
    let all = (0..256).map(|k| [k / 64, k / 16 % 4, k / 4 % 4, k % 4]);
    let wrong = all.filter(|order| (0..4).all(|i| order.contains(&i)) && *order != [0, 1, 2, 3]);
    wrong.map(|order| {
        let sentence =
            "The values are right, but belong to other vertices of the element. Which entry belongs to element[0]?";
        Candidate::new("wrong vertex order", sentence, move |trial, _| {
            let input = with_element(&trial.input, |element| order.map(|i| element[i]))?;
            crate::reference::trial::Trial { input, ..trial.clone() }.run(&Local(REFERENCE)).ok()
        })
    })
}

fn with_element(input: &Input, change: impl Fn([usize; 4]) -> [usize; 4]) -> Option<Input> {
    let mut input = input.clone();
    match &mut input {
        Input::Shape { element, .. } | Input::Kinetic { element, .. } | Input::Quadrature { element, .. } => {
            *element = change(*element);
        }
        Input::Elastic(elastic) => elastic.element = change(elastic.element),
        _ => return None,
    }
    Some(input)
}

fn local(input: &Input) -> Option<Input> {
    with_element(input, |_| [0, 1, 2, 3])
}

fn local_in_q(input: &Input) -> Option<Input> {
    let Input::Elastic(of) = input else { return None };
    let mut q = of.q.clone();
    for (i, vertex) in of.element.into_iter().enumerate() {
        q.fixed_rows_mut::<3>(3 * vertex).copy_from(&of.q.fixed_rows::<3>(3 * i));
    }
    Some(Input::Elastic(Elastic { q, ..of.clone() }))
}

fn factor_3_left_out(input: &Input) -> Option<Input> {
    let Input::Kinetic { qdot, element, density, volume } = input else { return None };
    let mut read = qdot.clone();
    for &vertex in element {
        read.fixed_rows_mut::<3>(3 * vertex).copy_from(&qdot.fixed_rows::<3>(vertex));
    }
    Some(Input::Kinetic { qdot: read, element: *element, density: *density, volume: *volume })
}

fn swapped(input: &Input) -> Option<Input> {
    let mut input = input.clone();
    let (C, D) = match &mut input {
        Input::Density { C, D, .. } => (C, D),
        Input::Elastic(Elastic { C, D, .. }) | Input::Mesh(Mesh { C, D, .. }) => (C, D),
        _ => return None,
    };
    std::mem::swap(C, D);
    Some(input)
}

fn stacked(V: &[Vector3<f64>]) -> DVector<f64> {
    DVector::from_iterator(3 * V.len(), V.iter().flatten().copied())
}

fn points(q: &DVector<f64>) -> Vec<Vector3<f64>> {
    (0..q.len() / 3).map(|vertex| q.fixed_rows::<3>(3 * vertex).into_owned()).collect()
}

fn with_positions(input: &Input, change: impl Fn(&mut DVector<f64>, &mut Vec<Vector3<f64>>)) -> Option<Input> {
    let mut input = input.clone();
    match &mut input {
        Input::Elastic(Elastic { q, V, .. }) | Input::Mesh(Mesh { q, V, .. }) => change(q, V),
        _ => return None,
    }
    Some(input)
}

fn rest_for_deformed(input: &Input) -> Option<Input> {
    with_positions(input, |q, V| *q = stacked(V))
}

fn deformed_for_rest(input: &Input) -> Option<Input> {
    with_positions(input, |q, V| *V = points(q))
}

fn rest_and_deformed_swapped(input: &Input) -> Option<Input> {
    with_positions(input, |q, V| (*q, *V) = (stacked(V), points(q)))
}

fn no_rest_length(input: &Input) -> Option<Input> {
    let &Input::Spring { q0, q1, stiffness, .. } = input else { return None };
    Some(Input::Spring { q0, q1, l0: 0.0, stiffness })
}

fn transposed_F(input: &Input) -> Option<Input> {
    let &Input::Density { F, C, D } = input else { return None };
    Some(Input::Density { F: F.transpose(), C, D })
}

fn with_step(input: &Input, change: impl Fn(&mut Step)) -> Option<Input> {
    let Input::Step(step) = input else { return None };
    let mut step = step.clone();
    change(&mut step);
    Some(Input::Step(step))
}

fn missing_dt(input: &Input) -> Option<Input> {
    with_step(input, |step| step.system.force_factor = 1.0 / step.dt)
}

fn dt_for_dt_squared(input: &Input) -> Option<Input> {
    with_step(input, |step| step.system.stiffness_factor = 1.0 / step.dt)
}

fn anti_stiffness(input: &Input) -> Option<Input> {
    with_step(input, |step| step.system.stiffness_factor = -1.0)
}

fn anti_force(input: &Input) -> Option<Input> {
    with_step(input, |step| step.system.force_factor = -1.0)
}

fn no_stiffness(input: &Input) -> Option<Input> {
    with_step(input, |step| step.system.stiffness_factor = 0.0)
}

fn no_damping(input: &Input) -> Option<Input> {
    with_step(input, |step| step.system.damping = 0.0)
}

fn single_step(input: &Input) -> Option<Input> {
    let Input::Minimum { objective, start, max_steps } = input else { return None };
    Some(Input::Minimum { objective: objective.clone(), start: start.clone(), max_steps: 1.min(*max_steps) })
}

fn with_pick(input: &Input, change: impl Fn(&mut Pick)) -> Option<Input> {
    let Input::Pick(pick) = input else { return None };
    let mut pick = pick.clone();
    change(&mut pick);
    Some(Input::Pick(pick))
}

fn upside_down(input: &Input) -> Option<Input> {
    with_pick(input, |pick| pick.win.y = f64::from(2.0 * pick.viewport[1] + pick.viewport[3]) - pick.win.y)
}

fn no_corner(input: &Input) -> Option<Input> {
    with_pick(input, |pick| (pick.viewport[0], pick.viewport[1]) = (0.0, 0.0))
}

fn squared_radius(input: &Input) -> Option<Input> {
    with_pick(input, |pick| pick.radius = pick.radius.sqrt())
}
