//! Published cases, most of them with quadratic elements: values of other programs and of closed forms on sequences of meshes.

mod case;
mod contact;
mod cook;
mod elastica;
mod frequency;
mod lame;
mod le1;
mod le10;
mod le11;
mod lee;
mod limit_load;
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
        ("le1", "NAFEMS LE1: an elliptic membrane", le1::run),
        ("le10", "NAFEMS LE10: a thick plate", le10::run),
        ("le11", "NAFEMS LE11: a solid under an initial strain", le11::run),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_published_case_comes_out_right_on_its_coarser_meshes() {
        let part = |&(name, _, run): &super::super::Entry| (name, run(std::path::Path::new(""), true));
        let problem = |(name, part): (&str, Result<crate::study::Part, String>)| {
            let marks = part.unwrap_or_else(crate::study::Part::failed).marks;
            assert!(!marks.is_empty(), "{name}");
            let wrong = marks.into_iter().filter(|mark| mark.holds != Some(true));
            wrong.map(|mark| format!("{name}: {mark:?}")).collect::<Vec<_>>()
        };
        let problems: Vec<String> = BENCHMARKS.parts.iter().map(part).flat_map(problem).collect();
        assert!(problems.is_empty(), "{}", problems.join("\n"));
    }
}
