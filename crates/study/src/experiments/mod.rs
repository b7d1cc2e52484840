//! Experiments beside figures of others: those of the theses from which this software descends, and published benchmarks.

pub mod benchmarks;
mod drawing;
pub mod flat;
mod mistake;
pub mod rtfem;

use std::io;
use std::path::Path;

use crate::study::{Case, Finished, Found, Page, Part, Result, Study, write};

/// A part: its name as an argument of the program, its title, and its run, which takes the folder `data` and whether it is to be short.
type Entry = (&'static str, &'static str, fn(&Path, bool) -> Result<Part>);

/// A page of experiments: those of a thesis, or published cases.
pub struct Collection {
    /// Name of its page, without the ending.
    pub name: &'static str,
    title: &'static str,
    text: &'static str,
    parts: &'static [Entry],
}

impl Collection {
    /// Names of the parts, in their order.
    pub fn parts(&self) -> impl Iterator<Item = &'static str> {
        self.parts.iter().map(|(name, ..)| *name)
    }
}

/// Experiments of a page: one part of them, or all.
pub struct Experiments<'a> {
    /// The page.
    pub of: &'static Collection,
    /// The name of the part; `None` for all.
    pub part: Option<&'a str>,
    /// The folder with pictures and meshes.
    pub data: &'a Path,
    /// Fewer and coarser bodies; times are not judged.
    pub quick: bool,
}

impl Study for Experiments<'_> {
    type Row = Part;

    fn arguments(&self) -> Vec<String> {
        let words = ["experiment", self.of.name].into_iter().chain(self.part).chain(self.quick.then_some("--quick"));
        words.map(str::to_owned).collect()
    }

    fn cases(&self) -> Vec<Case<'_, Part>> {
        let chosen = self.of.parts.iter().filter(|(name, ..)| self.part.is_none_or(|part| part == *name));
        let case = |&(name, title, run): &Entry| {
            Case::new(name, move || run(self.data, self.quick).unwrap_or_else(Part::failed).titled(name, title))
        };
        chosen.map(case).collect()
    }

    fn finish(&self, found: Found<Part>, out: &Path) -> io::Result<Finished> {
        let &Collection { name, title, text, .. } = self.of;
        let page = Page { name, title, text, machine: found.machine, quick: self.quick, parts: found.rows };
        write(&page, out)?;
        let Finished { mut lines, failed } = page.finished();
        lines.push(out.join(format!("{name}.html")).display().to_string());
        Ok(Finished { lines, failed })
    }
}
