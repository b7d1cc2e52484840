//! Stands for [wesl](https://docs.rs/wesl), a compiler of WGSL with imports and conditions, which brings a parser generator and two
//! regular expression engines. Only kiss3d calls it, from `compile_wesl` in its `builtin/mod.rs`, to compose its own shaders.
//!
//! This composer works on their text: it joins the modules that are imported and resolves `@if`. Names stay as they are, so that two declarations of
//! one name are an error of the shader, and what no entry point reaches stays too. `tests/shaders.rs` composes every shader of kiss3d and lets naga
//! validate it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Path of a module, `package::common`.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct ModulePath(String);

impl std::str::FromStr for ModulePath {
    type Err = Error;

    fn from_str(path: &str) -> Result<Self, Error> {
        Ok(ModulePath(path.trim().to_string()))
    }
}

/// A shader that cannot be composed, and why.
#[derive(Debug)]
pub struct Error(String);

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}

/// Modules by their path.
#[derive(Default)]
pub struct VirtualResolver(BTreeMap<ModulePath, String>);

impl VirtualResolver {
    pub fn new() -> Self {
        Self::default()
    }

    pub fn add_module(&mut self, path: ModulePath, source: String) {
        self.0.insert(path, source);
    }
}

/// Options of the real compiler that kiss3d sets; they change nothing here.
#[derive(Default)]
pub struct CompileOptions {
    pub validate: bool,
}

/// The composer: modules, and features that are on.
pub struct Wesl {
    modules: VirtualResolver,
    features: BTreeSet<String>,
}

impl Wesl {
    pub fn new(_base: &str) -> Self {
        Wesl { modules: VirtualResolver::new(), features: BTreeSet::new() }
    }

    pub fn set_custom_resolver(self, modules: VirtualResolver) -> Self {
        Wesl { modules, ..self }
    }

    pub fn set_options(&mut self, _options: CompileOptions) {}

    pub fn set_feature(&mut self, name: &str, on: bool) {
        if on {
            self.features.insert(name.to_string());
        } else {
            self.features.remove(name);
        }
    }

    /// Returns the module `root` with all that it imports, as WGSL.
    pub fn compile(&self, root: &ModulePath) -> Result<String, Error> {
        let mut declarations = Vec::new();
        self.collect(root, &mut BTreeSet::new(), &mut declarations)?;
        // Directives stand before all declarations.
        let is_directive =
            |item: &&String| ["enable", "requires", "diagnostic"].iter().any(|word| item.starts_with(word));
        let (directives, others): (Vec<&String>, Vec<&String>) = declarations.iter().partition(is_directive);
        Ok(directives.into_iter().chain(others).map(|item| format!("{item}\n")).collect())
    }

    /// Collects the declarations of a module behind those of the modules that it imports, each module once.
    fn collect(
        &self,
        path: &ModulePath,
        seen: &mut BTreeSet<ModulePath>,
        declarations: &mut Vec<String>,
    ) -> Result<(), Error> {
        if !seen.insert(path.clone()) {
            return Ok(());
        }
        let source = self.modules.0.get(path).ok_or_else(|| Error(format!("there is no module {}", path.0)))?;
        let text = resolve_conditions(without_comments(source), &self.features)?;
        let mut rest = text.trim_start();
        while !rest.is_empty() {
            let (item, behind) = rest.split_at(end_of_item(rest));
            match item.strip_prefix("import ") {
                Some(import) => {
                    let names =
                        import.find('{').or_else(|| import.rfind("::").map(|at| at + 2)).unwrap_or(import.len());
                    self.collect(&import[..names].trim_end_matches("::").parse()?, seen, declarations)?;
                }
                None => declarations.push(item.to_string()),
            }
            rest = behind.trim_start();
        }
        Ok(())
    }
}

/// Removes comments, which may contain anything.
fn without_comments(source: &str) -> String {
    let lines: Vec<&str> = source.lines().map(|line| line.split("//").next().unwrap_or("")).collect();
    let mut text = lines.join("\n");
    while let Some(start) = text.find("/*") {
        let end = text[start..].find("*/").map_or(text.len(), |length| start + length + 2);
        text.replace_range(start..end, " ");
    }
    text
}

/// Keeps what stands behind an `@if` whose condition holds, and removes what stands behind another. A block loses its braces.
fn resolve_conditions(mut text: String, features: &BTreeSet<String>) -> Result<String, Error> {
    while let Some(start) = text.find("@if(") {
        let behind = &text[start + "@if(".len()..];
        let (condition, behind) =
            behind.split_once(')').ok_or_else(|| Error("an @if lacks its parenthesis".to_string()))?;
        if condition.contains('(') {
            return Err(Error(format!("conditions with parentheses are not supported: {condition}")));
        }
        let holds = condition.split("||").any(|terms| {
            terms.split("&&").all(|term| match term.trim().strip_prefix('!') {
                Some(name) => !features.contains(name.trim()),
                None => features.contains(term.trim()),
            })
        });
        let item = behind.trim_start();
        let (item, rest) = item.split_at(end_of_item(item));
        let kept = match item.strip_prefix('{').and_then(|block| block.strip_suffix('}')) {
            _ if !holds => "",
            Some(block) => block,
            None => item,
        };
        text = format!("{}{kept}{rest}", &text[..start]);
    }
    Ok(text)
}

/// Returns where the first declaration, statement or struct member ends: behind its `;`, its closing brace or its `,`.
fn end_of_item(text: &str) -> usize {
    let is_member = behind_attributes(text).trim_start_matches(is_word).trim_start().starts_with(':');
    let mut depth = 0;
    for (i, c) in text.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            '<' if is_member => depth += 1,
            ')' | ']' | '}' if depth == 0 => return i, // of the struct or block around it
            '}' if depth == 1 && !is_member => return i + 1,
            ')' | ']' | '}' => depth -= 1,
            '>' if is_member => depth -= 1,
            ',' if depth == 0 && is_member => return i + 1,
            ';' if depth == 0 => return i + 1,
            _ => {}
        }
    }
    text.len()
}

/// Skips `@group(0) @binding(1)` and the like.
fn behind_attributes(text: &str) -> &str {
    let mut rest = text.trim_start();
    while let Some(attribute) = rest.strip_prefix('@') {
        rest = attribute.trim_start_matches(is_word).trim_start();
        if rest.starts_with('(') {
            rest = rest.split_once(')').map_or("", |(_, behind)| behind).trim_start();
        }
    }
    rest
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}
