//! Planted copies of right solutions are found, and independent ones are not taken for copies.

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use grader::submission::NAMES;
use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};

use super::fingerprints::Document;
use super::pairs::pairs;
use super::*;
use crate::grading::repository;
use crate::reports::similar;
use crate::rubric::Rubric;

const STYLES: [&str; 8] = [
    "src",
    "grader/tests/other_style/src",
    "grader/tests/styles/algebra/src",
    "grader/tests/styles/dense/src",
    "grader/tests/styles/indices/src",
    "grader/tests/styles/iterators/src",
    "grader/tests/styles/recursive/src",
    "grader/tests/styles/triplets/src",
];

/// A change of one text.
type Disguise = fn(&str) -> String;

/// Ways to disguise a copy.
const DISGUISES: [(&str, Disguise); 4] = [
    ("renamed", renamed),
    ("reordered", reordered),
    ("split", split),
    ("all three", |text| split(&renamed(&reordered(text)))),
];

static HANDOUT: LazyLock<Given> =
    LazyLock::new(|| given(&crate::handout::files(&repository(), &Rubric::load(None).unwrap()).unwrap()));

/// A submission in each style, by the author of that number.
static ORIGINALS: LazyLock<Vec<Document>> =
    LazyLock::new(|| STYLES.iter().enumerate().map(|(author, style)| document(author, style, str::to_owned)).collect());

/// The work of an author: the solutions in a style, in a disguise.
fn document(author: usize, style: &str, disguise: Disguise) -> Document {
    let texts = texts_in(&repository().join(style)).iter().map(|(name, text)| (*name, disguise(text))).collect();
    Document::new(author.to_string(), vec![author.to_string()], texts, &HANDOUT)
}

fn texts_in(folder: &Path) -> Vec<(&'static str, String)> {
    NAMES.map(|name| (name, fs::read_to_string(folder.join(format!("{name}.rs"))).unwrap())).to_vec()
}

fn map_idents(tokens: TokenStream, change: &impl Fn(String) -> String) -> TokenStream {
    let one = |token| match token {
        TokenTree::Ident(word) => TokenTree::Ident(Ident::new(&change(word.to_string()), Span::call_site())),
        TokenTree::Group(group) => TokenTree::Group(Group::new(group.delimiter(), map_idents(group.stream(), change))),
        other => other,
    };
    tokens.into_iter().map(one).collect()
}

/// Renames the variables and arguments of the file. For simplicity it renames every short word.
fn renamed(text: &str) -> String {
    let is_kept = |word: &str| syn::parse_str::<syn::Ident>(word).is_err() || word == "f64" || word.len() > 5;
    let change = |word: String| if is_kept(&word) { word } else { format!("my_{word}") };
    map_idents(text.parse().unwrap(), &change).to_string()
}

/// The file's items, and in each body neighbouring pairs of `let`, the other way round.
fn reordered(text: &str) -> String {
    let file = syn::parse_file(text).unwrap();
    let mut items: Vec<String> = file.items.iter().map(|item| body_reordered(&quoted(item, text))).collect();
    items.reverse();
    items.join("\n")
}

fn quoted(item: &syn::Item, text: &str) -> String {
    use syn::spanned::Spanned;
    text[item.span().byte_range()].to_owned()
}

fn body_reordered(item: &str) -> String {
    let lines: Vec<&str> = item.lines().collect();
    let is_let = |line: &str| line.starts_with("    let ") && line.ends_with(';');
    let mut changed: Vec<&str> = Vec::new();
    let mut next = 0;
    while next < lines.len() {
        if next + 1 < lines.len() && is_let(lines[next]) && is_let(lines[next + 1]) {
            changed.extend([lines[next + 1], lines[next]]);
            next += 2;
        } else {
            changed.push(lines[next]);
            next += 1;
        }
    }
    changed.join("\n")
}

/// Each long body divided among helper functions of four statements.
fn split(text: &str) -> String {
    let tokens: TokenStream = text.parse().unwrap();
    let divided = tokens.into_iter().map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => divided(group.stream()),
        other => other.to_string(),
    });
    divided.collect::<Vec<_>>().join(" ")
}

fn divided(body: TokenStream) -> String {
    let (mut text, mut statements) = (String::from("{ "), 0);
    for token in body {
        let is_end = matches!(&token, TokenTree::Punct(mark) if mark.as_char() == ';');
        text.push_str(&format!("{token} "));
        statements += usize::from(is_end);
        if is_end && statements % 4 == 0 {
            text.push_str(&format!("helper{statements}(a, b) }} fn helper{statements}(a: &[f64], b: f64) -> f64 {{ "));
        }
    }
    text + "}"
}

/// Originals, and for each author a copy in this disguise; the author of each.
fn class(disguise: Disguise) -> (Vec<Document>, Vec<usize>) {
    let copies = STYLES.iter().enumerate().map(|(author, style)| document(author + STYLES.len(), style, disguise));
    let all: Vec<_> = ORIGINALS.iter().cloned().chain(copies).collect();
    let authors = (0..all.len()).map(|author| author % STYLES.len()).collect();
    (all, authors)
}

#[test]
fn planted_copies_are_found_and_independent_solutions_are_not_taken_for_copies() {
    let mut table = Vec::new();
    for (disguise, change) in DISGUISES {
        let (documents, authors) = class(change);
        let found = pairs(&documents);
        let is_copy = |pair: &&pairs::Pair| authors[pair.members[0]] == authors[pair.members[1]];
        let told: Vec<_> = found.iter().filter(|pair| pair.share >= LEAST_SHARE).collect();
        let right = told.iter().filter(|pair| is_copy(pair)).count();
        let (precision, recall) = (right as f64 / told.len() as f64, right as f64 / STYLES.len() as f64);
        let least = found.iter().filter(is_copy).map(|pair| pair.share).fold(1.0, f64::min);
        let most = found.iter().filter(|pair| !is_copy(pair)).map(|pair| pair.share).fold(0.0, f64::max);
        println!(
            "{disguise:>10}: precision {precision:.2}, recall {recall:.2}; copies {least:.2}.., others ..{most:.2}"
        );
        table.push((disguise, precision, recall));
        assert!(least > 0.6 && most < 0.2, "the line of {LEAST_SHARE} is far from both: {least}, {most}");
    }
    assert_eq!(table, DISGUISES.map(|(disguise, _)| (disguise, 1.0, 1.0)));
}

#[test]
fn half_a_copy_is_found_beside_both_of_its_sources() {
    let sources = [0, 1].map(|author: usize| texts_in(&repository().join(STYLES[author])));
    let mixed = (0..NAMES.len()).map(|i| (NAMES[i], renamed(&sources[i % 2][i].1))).collect();
    let mut class = ORIGINALS.clone();
    class.push(Document::new("8".to_owned(), vec!["8".to_owned()], mixed, &HANDOUT));
    let told = pairs(&class).into_iter().filter(|pair| pair.share >= LEAST_SHARE).map(|pair| pair.members);
    let mut told: Vec<_> = told.collect();
    told.sort();
    assert_eq!(told, [[0, 8], [1, 8]]);
}

/// Submissions of all authors, those from the second to the last copy as copies of the first, which is `copied` in its disguise.
fn class_with_copies(copies: usize, copied: &Document) -> Vec<Document> {
    let original = |(author, own): (usize, &Document)| {
        let name = author.to_string();
        let text = if (1..copies).contains(&author) { copied } else { own };
        Document { submission: name.clone(), students: vec![name], ..text.clone() }
    };
    ORIGINALS.iter().enumerate().map(original).collect()
}

#[test]
fn copies_are_found_from_one_pair_to_the_whole_class() {
    for (disguise, change) in DISGUISES {
        let copied = document(0, STYLES[0], change);
        for copies in [2, 5, STYLES.len()] {
            let class = class_with_copies(copies, &copied);
            let found = Found::in_class(&class);
            let mut told: Vec<_> =
                found.pairs.iter().filter(|pair| pair.share >= LEAST_SHARE).map(|pair| pair.members).collect();
            told.sort();
            let expected: Vec<_> = (0..copies).flat_map(|a| (a + 1..copies).map(move |b| [a, b])).collect();
            let all = found.origins.last().unwrap();
            println!(
                "{disguise:>10}, {copies} of {}: {} of {} pairs, {:.2} left out, {:.2} common",
                STYLES.len(),
                told.len(),
                expected.len(),
                all.given_share(),
                all.common_share()
            );
            assert_eq!(told, expected, "{disguise}, {copies} copies");
            assert_eq!(found.groups, [(0..copies).collect::<Vec<_>>()]);
            assert!(all.given_share() < 0.45, "copies are taken for given text: {all:?}");
        }
    }
    let class = class_with_copies(5, &document(0, STYLES[0], renamed));
    let text = similar::text(&class, &Found::in_class(&class));
    assert!(
        text.contains("group of 5: 0, 1, 2, 3, 4\n") && text.contains("8 submissions; 10 pairs share 25 %"),
        "{text}"
    );
    assert!(text.contains("More than half of the class has") && text.contains("\nimplicit_euler "), "{text}");
}

#[test]
fn precision_on_the_independent_solutions_of_the_repository() {
    let class = &ORIGINALS;
    let found = Found::in_class(class);
    println!("{}", similar::text(class, &found));
    for pair in found.pairs.iter().take(5) {
        println!(
            "{} and {}: {:.3}, longest run {}",
            STYLES[pair.members[0]], STYLES[pair.members[1]], pair.share, pair.runs[0].length
        );
    }
    assert!(found.pairs[0].share < 0.2 && found.groups.is_empty(), "{}", found.pairs[0].share);
}

#[test]
fn the_code_on_the_pages_of_the_handout_is_given() {
    let code = "let a = b.c(d) + e[0] * f; for i in 0..4 { a[i] += g.h(i, 2.0) - j; } return a / k;";
    let page = format!("Text.\n```rust\n{code}\n```\nMore `code` text.\n```\nlet x = 1;\n```\n");
    let given = given(&Files::from([("include-docs/f.md".into(), page.into_bytes())]));
    assert!(!given.exercises.is_empty() && given.places(&all_pieces(code)).iter().all(|is_given| *is_given));
}

#[test]
fn a_short_run_of_the_given_libraries_is_coincidence_and_a_long_one_is_given() {
    let text = |length: usize| {
        (0..length).map(|i| ["a", "+", "1", "*", ";"][(i * i + i / 7) % 5]).collect::<Vec<_>>().join(" ")
    };
    let (short, long) = (all_pieces(&text(40)), all_pieces(&text(60)));
    let library = Given { libraries: long.iter().copied().collect(), ..Given::default() };
    assert!(library.places(&short).iter().all(|is_given| !is_given));
    assert!(library.places(&long).iter().all(|is_given| *is_given));
    let exercises = Given { exercises: library.libraries, ..Given::default() };
    assert!(exercises.places(&short).iter().all(|is_given| *is_given));
}

#[test]
fn code_that_was_given_beside_the_handout_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("lecture")).unwrap();
    let code = texts_in(&repository().join("src"))[2].1.clone();
    fs::write(folder.path().join("lecture/a.rs"), &code).unwrap();
    let mut files = Files::new();
    crate::handout::add_given(&folder.path().join("lecture"), &mut files).unwrap();
    assert!(given(&files).places(&all_pieces(&code)).iter().all(|is_given| *is_given));
    assert!(crate::handout::add_given(&folder.path().join("nothing"), &mut files).is_err());
}

#[test]
fn what_the_handout_gave_and_what_a_group_shares_is_no_copy() {
    let solved = texts_in(&repository().join("src"));
    let document = |students: &[&str], handout: &Given| {
        let students = students.iter().map(|name| (*name).to_owned()).collect();
        Document::new(String::new(), students, solved.clone(), handout)
    };
    let all_given =
        Given { exercises: solved.iter().flat_map(|(_, text)| all_pieces(text)).collect(), ..Given::default() };
    assert!(pairs(&[document(&["anna"], &all_given), document(&["bob"], &all_given)]).is_empty());
    assert!(pairs(&[document(&["anna", "carl"], &HANDOUT), document(&["carl"], &HANDOUT)]).is_empty());
    let whole = pairs(&[document(&["anna"], &HANDOUT), document(&["bob"], &HANDOUT)]);
    assert!(whole.len() == 1 && whole[0].share > 0.95, "{}", whole[0].share);
}

#[test]
fn a_pair_side_by_side_marks_what_both_share_and_shows_text_as_text() {
    let handout = Given::default();
    let shared = "let x = a * b + c[0] - d(e, f).g() / 2.0; if x > 1.0 { return x - 3.0 * y[1] + z; }";
    let document = |student: &str, own: &str| {
        let text = format!("fn f() {{\n    {own}\n    {shared}\n}}\n// </pre><script>alert(1)</script>\n");
        Document::new(student.to_owned(), vec![student.to_owned()], vec![("psi_neo_hookean", text)], &handout)
    };
    let class = [document("<b>anna", "loop {}"), document("bob", "for i in 0..3 { [i, i, i]; }")];
    let found = pairs(&class);
    let page = similar::side_by_side(&class, &found[0]);
    assert!(!page.contains("<script") && !page.contains("<b>anna") && page.contains("&lt;/pre&gt;&lt;script&gt;"));
    assert_eq!(page.matches("<mark").count(), page.matches("</mark>").count());
    assert!(page.matches("<mark").count() >= 2 && page.contains("psi_<wbr>neo_<wbr>hookean"), "{page}");
    let list = similar::list(&class, &Found::in_class(&class));
    assert!(list.contains("pairs/001.html") && list.contains("&lt;b&gt;anna") && !list.contains("<b>anna"), "{list}");
}
