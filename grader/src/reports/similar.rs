//! Pairs of submissions that are alike: `similar.csv`, `similar.html`, and a page for each pair to read side by side. The text that was
//! left out is in `origin.csv`.

use std::fs;
use std::io;
use std::path::Path;

use maud::{Markup, html};

use super::page::{name, page};
use super::{csv, escape, write_file};
use crate::similar::fingerprints::{Document, File};
use crate::similar::origin::Origin;
use crate::similar::pairs::Pair;
use crate::similar::{Found, LEAST_SHARE};

/// Pages of pairs, the most alike first.
const MOST_PAGES: usize = 200;

/// Groups that the terminal lists, and names of each.
const MOST_GROUPS: usize = 20;
const MOST_NAMES: usize = 12;

/// From this part of a class's text on, common text is reported as such.
const MUCH: f64 = 0.2;

/// Colours of runs, in turn.
const COLOURS: usize = 6;

/// Writes the tables, the list and the pages into a folder.
pub fn write(class: &[Document], found: &Found, folder: &Path) -> io::Result<()> {
    write_file(folder, "similar.csv", &table(class, &found.pairs)?)?;
    write_file(folder, "origin.csv", &origin_table(&found.origins)?)?;
    write_file(folder, "similar.html", &list(class, found))?;
    let pages = folder.join("pairs");
    fs::create_dir_all(&pages)?;
    for (index, pair) in shown(&found.pairs).enumerate() {
        write_file(&pages, &file_name(index), &side_by_side(class, pair))?;
    }
    Ok(())
}

/// The result for a terminal: the origin of the text by function, then the number of similar pairs and their groups.
pub fn text(class: &[Document], found: &Found) -> String {
    let mut text = format!("{:36}{:>8}{:>10}{:>10}\n", "function", "tokens", "left out", "common");
    for origin in &found.origins {
        let [given, common] = shares(origin);
        text.push_str(&format!("{:36}{:>8}{given:>10}{common:>10}\n", origin.function, origin.tokens));
    }
    text.push_str(
        "left out: the handout gave it; common: more than half of the submissions have it alike, and it counts\n",
    );
    if let Some(warning) = warning(found) {
        text.push_str(&format!("{warning}\n"));
    }
    let names = |group: &Vec<usize>| {
        let names: Vec<_> =
            group.iter().take(MOST_NAMES).map(|place| escape::line(&class[*place].submission)).collect();
        let more = if group.len() > MOST_NAMES { ", …" } else { "" };
        format!("group of {}: {}{more}\n", group.len(), names.join(", "))
    };
    found.groups.iter().take(MOST_GROUPS).for_each(|group| text.push_str(&names(group)));
    if found.groups.len() > MOST_GROUPS {
        text.push_str(&format!("{} more groups are on the page\n", found.groups.len() - MOST_GROUPS));
    }
    text + &format!("{} submissions; {}: ", class.len(), counted(&found.pairs))
}

/// The number of similar pairs as a sentence's subject and verb.
fn counted(pairs: &[Pair]) -> String {
    let share = 100.0 * LEAST_SHARE;
    match similar(pairs).count() {
        1 => format!("1 pair shares {share} % or more"),
        several => format!("{several} pairs share {share} % or more"),
    }
}

/// A sentence about a class with much common text.
fn warning(found: &Found) -> Option<String> {
    let all = found.origins.last().filter(|all| all.common_share() >= MUCH)?;
    Some(format!(
        "More than half of the class has {} of its text alike: copies of one source, or code that you gave beside the handout (name it with --given).",
        shares(all)[1]
    ))
}

fn shares(origin: &Origin) -> [String; 2] {
    [origin.given_share(), origin.common_share()].map(|share| format!("{:.0} %", 100.0 * share))
}

/// The text of `origin.csv`.
fn origin_table(origins: &[Origin]) -> io::Result<String> {
    let heading = ["function", "tokens", "left_out", "common"].map(str::to_owned).to_vec();
    let rows = origins.iter().map(|origin| {
        let figures = [origin.tokens, origin.given, origin.common].map(|tokens| tokens.to_string());
        [origin.function.to_owned()].into_iter().chain(figures).collect()
    });
    csv::text(heading, rows)
}

fn similar(pairs: &[Pair]) -> impl Iterator<Item = &Pair> {
    pairs.iter().filter(|pair| pair.share >= LEAST_SHARE)
}

fn shown(pairs: &[Pair]) -> impl Iterator<Item = &Pair> {
    similar(pairs).take(MOST_PAGES)
}

fn file_name(index: usize) -> String {
    format!("{:03}.html", index + 1)
}

/// The text of `similar.csv`: all pairs with a shared run, however short.
fn table(class: &[Document], pairs: &[Pair]) -> io::Result<String> {
    let heading = ["submission", "other", "share", "shared_tokens", "longest_run"].map(str::to_owned).to_vec();
    let rows = pairs.iter().map(|pair| {
        let names = pair.members.map(|index| escape::cell(&class[index].submission));
        let figures = [format!("{:.3}", pair.share), most(pair).to_string(), longest(pair).to_string()];
        names.into_iter().chain(figures).collect()
    });
    csv::text(heading, rows)
}

fn most(pair: &Pair) -> usize {
    pair.shared[0].max(pair.shared[1])
}

fn longest(pair: &Pair) -> usize {
    pair.runs.iter().map(|run| run.length).max().unwrap_or(0)
}

/// The text of `similar.html`.
pub fn list(class: &[Document], found: &Found) -> String {
    let row = |(index, pair): (usize, &Pair)| -> Markup {
        html! {
            tr {
                td { a href=(format!("./pairs/{}", file_name(index))) { (escape::line(&class[pair.members[0]].submission)) " and "
                    (escape::line(&class[pair.members[1]].submission)) } }
                td class="right" { (format!("{:.0} %", 100.0 * pair.share)) }
                td class="right" { (most(pair)) } td class="right" { (longest(pair)) }
            } "\n"
        }
    };
    let names = |group: &Vec<usize>| -> String {
        group.iter().map(|place| escape::line(&class[*place].submission)).collect::<Vec<_>>().join(", ")
    };
    let body = html! {
        h1 { "Similar submissions" }
        p { (class.len()) " submissions; " (counted(&found.pairs)) ". Names, numbers, comments and what the handout gave are left out. A shared
            run is a reason to read both, not a verdict: short functions have few right forms." } "\n"
        @if let Some(warning) = warning(found) { p { b { (warning) } } "\n" }
        @if !found.groups.is_empty() {
            h2 { "Groups" }
            ul { @for group in &found.groups { li { (group.len()) ": " (names(group)) } "\n" } }
            h2 { "Pairs" }
            div class="scroll" { table {
                tr { th { "submissions" } th class="right" { "share" } th class="right" { "tokens" } th class="right" { "longest run" } } "\n"
                @for pair in shown(&found.pairs).enumerate() { (row(pair)) }
            } }
        }
        p class="soft" { (format!("Pairs from {:.0} % on, at most {MOST_PAGES}; similar.csv lists all.", 100.0 * LEAST_SHARE)) }
        (origins(&found.origins))
    };
    page("Similar submissions", body)
}

fn origins(origins: &[Origin]) -> Markup {
    html! {
        h2 { "Where the text comes from" }
        p { "The handout gave what is left out. More than half of the submissions have the common text alike, and it counts." }
        div class="scroll" { table {
            tr { th { "function" } th class="right" { "tokens" } th class="right" { "left out" } th class="right" { "common" } } "\n"
            @for origin in origins {
                tr {
                    td class="name" { (name(origin.function)) } td class="right" { (origin.tokens) }
                    @for share in shares(origin) { td class="right" { (share) } }
                } "\n"
            }
        } }
    }
}

/// The page of a pair: each function with a shared run, both texts, equal runs in equal colours with equal numbers.
pub fn side_by_side(class: &[Document], pair: &Pair) -> String {
    let documents = pair.members.map(|index| &class[index]);
    let names = documents.map(|document| escape::line(&document.submission));
    let has_run = |side: usize, file: usize| pair.runs.iter().any(|run| run.places[side].0 == file);
    let mut functions: Vec<&str> = Vec::new();
    for (side, document) in documents.iter().enumerate() {
        let with_run = document.files.iter().enumerate().filter(|(index, _)| has_run(side, *index));
        functions.extend(with_run.map(|(_, file)| file.name));
    }
    functions.sort_unstable();
    functions.dedup();
    let column = |side: usize, function: &str| -> Markup {
        let found = documents[side].files.iter().position(|file| file.name == function);
        html! {
            div {
                h3 { (names[side]) }
                @if let Some(index) = found { pre { (marked(&documents[side].files[index], pair, (side, index))) } }
                @else { p class="soft" { "not written" } }
            } "\n"
        }
    };
    let body = html! {
        h1 { (names[0]) " and " (names[1]) }
        p { (format!("{:.0} % of the text of one is in the other, in {} runs.", 100.0 * pair.share, pair.runs.len())) } "\n"
        @for function in functions {
            h2 { (name(function)) } "\n"
            div class="sides" { (column(0, function)) (column(1, function)) } "\n"
        }
    };
    page(&format!("{} and {}", names[0], names[1]), body)
}

/// A file with the runs of one side marked. Where runs overlap, the longer one is shown.
fn marked(file: &File, pair: &Pair, (side, index): (usize, usize)) -> Markup {
    let mut owner: Vec<Option<usize>> = vec![None; file.tokens.len()];
    for (number, run) in pair.runs.iter().enumerate().filter(|(_, run)| run.places[side].0 == index) {
        let start = run.places[side].1;
        owner[start..start + run.length]
            .iter_mut()
            .filter(|owner| owner.is_none())
            .for_each(|owner| *owner = Some(number));
    }
    let mut pieces: Vec<(Option<usize>, &str)> = Vec::new();
    let (mut done, mut next) = (0, 0);
    while next < owner.len() {
        let length = owner[next..].iter().take_while(|other| **other == owner[next]).count();
        let (start, end) = (file.tokens[next].start, file.tokens[next + length - 1].end);
        if owner[next].is_some() {
            pieces.extend([(None, &file.text[done..start]), (owner[next], &file.text[start..end])]);
            done = end;
        }
        next += length;
    }
    pieces.push((None, &file.text[done..]));
    html! {
        @for (run, text) in pieces {
            @match run {
                Some(run) => { mark class=(format!("run{}", run % COLOURS)) { sup { (run + 1) } (escape::plain(text)) } }
                None => { (escape::plain(text)) }
            }
        }
    }
}
