//! Finds the functions of the course that a file names.

use std::collections::BTreeSet;

use proc_macro2::{TokenStream, TokenTree};

use super::{NAMES, scan};

/// The functions whose names stand in the code of a file, its own among them; comments and texts do not count. Empty for a
/// file that is not Rust.
pub fn mentions(text: &str) -> BTreeSet<&'static str> {
    let find = |tokens: TokenStream| {
        let mut found = BTreeSet::new();
        collect(tokens, &mut found);
        found
    };
    scan::with_tokens(text, find).unwrap_or_default()
}

fn collect(tokens: TokenStream, found: &mut BTreeSet<&'static str>) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => collect(group.stream(), found),
            TokenTree::Ident(word) => found.extend(NAMES.into_iter().find(|name| word == name)),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_code_count_and_those_in_comments_texts_and_longer_names_do_not() {
        let text = "//! psi_neo_hookean\n/// T_linear_tetrahedron\nfn dV_linear_tetrahedron_dq() {\n    \
                    let _ = \"newtons_method\"; m!([crate::dpsi_neo_hookean_dF::x]) }";
        assert_eq!(Vec::from_iter(mentions(text)), ["dV_linear_tetrahedron_dq", "dpsi_neo_hookean_dF"]);
        assert!(mentions("fn psi_neo_hookean( {").is_empty());
    }
}
