//! Published cases, most of them with quadratic elements: values of other programs and of closed forms on sequences of meshes.

mod case;
mod contact;
mod cook;
mod elastica;
mod frequency;
mod lame;
mod lee;
mod limit_load;
mod nafems;
mod prony;
mod slender;
mod turek_hron;

use super::Collection;

/// The published cases.
pub const BENCHMARKS: Collection = Collection {
    name: "benchmarks",
    title: "Published benchmarks",
    text: "Cases that are published with their values or have a closed form, on sequences of meshes, most of them of quadratic elements. A mark judges the finest mesh.",
    parts: &[
        ("csm1", "Turek and Hron, CSM1: a beam behind a cylinder", turek_hron::csm1),
        ("csm2", "Turek and Hron, CSM2: the same, stiffer", turek_hron::csm2),
        ("csm3", "Turek and Hron, CSM3: the first from rest", turek_hron::csm3),
        ("cook", "Cook's membrane, plane stress", cook::plane_stress),
        ("cook-strain", "Cook's membrane, plane strain", cook::plane_strain),
        ("cook-incompressible", "Cook's membrane, large strain, nearly incompressible", cook::incompressible),
        ("le1", "NAFEMS LE1: an elliptic membrane", nafems::le1),
        ("le10", "NAFEMS LE10: a thick plate", nafems::le10),
        ("le11", "NAFEMS LE11: a solid under an initial strain", nafems::le11),
        ("mh-straight", "MacNeal and Harder: a straight beam", slender::straight),
        ("mh-curved", "MacNeal and Harder: a curved beam", slender::curved),
        ("mh-twisted", "MacNeal and Harder: a twisted beam", slender::twisted),
        ("elastica", "The elastica: a cantilever under an end force and an end moment", elastica::run),
        ("lee", "Lee's frame: a snap-through", lee::run),
        ("beam-frequency", "Frequencies of a cantilever", frequency::run),
        ("lame-sphere", "Lamé: a thick sphere under inner pressure", lame::sphere),
        ("lame-cylinder", "Lamé: a thick cylinder under inner pressure", lame::cylinder),
        ("j2-cylinder", "Limit load of a thick cylinder", limit_load::run),
        ("bar-impact", "A bar that hits a plane", contact::bar),
        ("hertz", "Hertz: a ball on a plane", contact::hertz),
        ("prony", "A Prony series under sudden and steady strain", prony::run),
    ],
};
