//! Reads which names a Rust source uses and passes on, from its tokens.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What one module names.
#[derive(Default)]
pub struct Module {
    /// Paths from the root of the crate, of modules or of items in them.
    pub named: BTreeSet<Vec<String>>,
    /// Names that stand for others: `pub use` of what a module below defines.
    pub passed_on: BTreeMap<String, Vec<String>>,
}

/// All modules of a crate by their path, the root's is empty; files that only tests use are left out.
pub fn modules(src: &Path) -> BTreeMap<Vec<String>, Module> {
    let mut texts = BTreeMap::new();
    read(src, &[], &mut texts);
    let of_tests: BTreeSet<Vec<String>> =
        texts.iter().flat_map(|(path, text)| test_modules(path, text)).collect();
    texts.retain(|path, _| !(1..=path.len()).any(|n| of_tests.contains(&path[..n])));
    let names: BTreeSet<Vec<String>> = texts.keys().cloned().collect();
    texts.iter().map(|(path, text)| (path.clone(), parse(path, text, &names))).collect()
}

fn read(folder: &Path, path: &[String], texts: &mut BTreeMap<Vec<String>, String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let file = entry.unwrap().path();
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        let below = [path, std::slice::from_ref(&name)].concat();
        if file.is_dir() {
            read(&file, &below, texts);
        } else if file.extension().is_some_and(|extension| extension == "rs") {
            let own = ["lib", "main", "mod"].contains(&name.as_str());
            let text = std::fs::read_to_string(&file).unwrap();
            texts.insert(if own { path.to_vec() } else { below }, text);
        }
    }
}

/// A token, brackets flattened.
#[derive(Clone, Debug, PartialEq)]
enum Token {
    Name(String),
    /// A punctuation mark or a bracket.
    Mark(char),
}

fn flatten(stream: TokenStream, tokens: &mut Vec<Token>) {
    for tree in stream {
        match tree {
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Brace => ('{', '}'),
                    Delimiter::Bracket => ('[', ']'),
                    Delimiter::Parenthesis => ('(', ')'),
                    Delimiter::None => (' ', ' '),
                };
                tokens.push(Token::Mark(open));
                flatten(group.stream(), tokens);
                tokens.push(Token::Mark(close));
            }
            TokenTree::Ident(name) => tokens.push(Token::Name(name.to_string())),
            TokenTree::Punct(mark) => tokens.push(Token::Mark(mark.as_char())),
            TokenTree::Literal(_) => tokens.push(Token::Mark('"')),
        }
    }
}

fn is_cfg_test(tree: &TokenTree) -> bool {
    matches!(tree, TokenTree::Group(group) if group.to_string().replace(' ', "") == "[cfg(test)]")
}

/// The code without what `#[cfg(test)]` stands before, and that.
fn without_tests(stream: TokenStream) -> (TokenStream, Vec<TokenStream>) {
    let (mut kept, mut of_tests) = (Vec::new(), Vec::new());
    let mut trees = stream.into_iter().peekable();
    while let Some(tree) = trees.next() {
        let is_attribute = matches!(&tree, TokenTree::Punct(mark) if mark.as_char() == '#');
        if !(is_attribute && trees.peek().is_some_and(is_cfg_test)) {
            kept.push(tree);
            continue;
        }
        let ends = |tree: &TokenTree| match tree {
            TokenTree::Punct(mark) => mark.as_char() == ';',
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
            _ => false,
        };
        let mut item = Vec::new();
        for tree in trees.by_ref() {
            let last = ends(&tree);
            item.push(tree);
            if last {
                break;
            }
        }
        of_tests.push(item.into_iter().collect());
    }
    (kept.into_iter().collect(), of_tests)
}

fn stream_of(path: &[String], text: &str) -> TokenStream {
    text.parse().unwrap_or_else(|error| panic!("{}: {error}", path.join("::")))
}

/// Modules in files of their own that only tests have: `#[cfg(test)] mod fixture;`.
fn test_modules(path: &[String], text: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for item in without_tests(stream_of(path, text)).1 {
        let mut tokens = Vec::new();
        flatten(item, &mut tokens);
        if let [.., Token::Name(word), Token::Name(name), Token::Mark(';')] = tokens.as_slice()
            && word == "mod"
        {
            found.push([path, std::slice::from_ref(name)].concat());
            // A file that another name than the module's leads to: simulation_tests.rs of simulation.rs.
            if let Some((own, above)) = path.split_last() {
                found.push([above, &[format!("{own}_{name}")]].concat());
            }
        }
    }
    found
}

/// What the module at `path` of a crate with modules `all` names.
pub fn parse(path: &[String], text: &str, all: &BTreeSet<Vec<String>>) -> Module {
    let mut tokens = Vec::new();
    flatten(without_tests(stream_of(path, text)).0, &mut tokens);
    let mut module = Module::default();
    // Names of modules, by which paths in the code may begin.
    let mut known: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for below in all.iter().filter(|below| below.len() == path.len() + 1 && below.starts_with(path)) {
        known.insert(below[path.len()].clone(), below.clone());
    }
    let begins = |k: usize| {
        tokens[k] == Token::Name("use".to_string()) && tokens.get(k + 1) != Some(&Token::Mark('<'))
    };
    let mut code = Vec::new();
    let mut k = 0;
    while k < tokens.len() {
        if !begins(k) {
            code.push(tokens[k].clone());
            k += 1;
            continue;
        }
        let end = (k..tokens.len()).find(|&e| tokens[e] == Token::Mark(';')).unwrap_or(tokens.len());
        let public = k > 0 && [Token::Name("pub".to_string()), Token::Mark(')')].contains(&tokens[k - 1]);
        for (named, name) in tree(&tokens[k + 1..end], &[]) {
            let Some(named) = from_root(path, &named, &known) else { continue };
            if public && named.len() > path.len() && named.starts_with(path) {
                module.passed_on.insert(name, named);
            } else {
                if all.contains(&named) {
                    known.insert(name, named.clone());
                }
                module.named.insert(named);
            }
        }
        k = end + 1;
    }
    module.named.extend(paths(&code).iter().filter_map(|named| from_root(path, named, &known)));
    module
}

/// The paths of a `use`, and the name that each gets here.
fn tree(tokens: &[Token], before: &[String]) -> Vec<(Vec<String>, String)> {
    let mut named = before.to_vec();
    let mut alias = None;
    let mut k = 0;
    while k < tokens.len() {
        match &tokens[k] {
            Token::Name(word) if word == "as" => {
                if let Some(Token::Name(name)) = tokens.get(k + 1) {
                    alias = Some(name.clone());
                }
                k += 1;
            }
            Token::Name(word) if word == "self" && !named.is_empty() => {}
            Token::Name(word) => named.push(word.clone()),
            Token::Mark('{') => return branches(&tokens[k + 1..tokens.len() - 1], &named),
            Token::Mark(_) => {}
        }
        k += 1;
    }
    let name = alias.or_else(|| named.last().cloned()).unwrap_or_default();
    vec![(named, name)]
}

/// The parts between the commas of a pair of brackets.
fn branches(tokens: &[Token], before: &[String]) -> Vec<(Vec<String>, String)> {
    let (mut depth, mut begin, mut found) = (0, 0, Vec::new());
    for k in 0..=tokens.len() {
        match tokens.get(k) {
            Some(Token::Mark('{')) => depth += 1,
            Some(Token::Mark('}')) => depth -= 1,
            Some(Token::Mark(',')) | None if depth == 0 => {
                if k > begin {
                    found.extend(tree(&tokens[begin..k], before));
                }
                begin = k + 1;
            }
            _ => {}
        }
    }
    found
}

/// Names joined by `::` in the code, two or more.
fn paths(code: &[Token]) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut k = 0;
    while k < code.len() {
        let mut named = Vec::new();
        while let Some(Token::Name(name)) = code.get(k) {
            named.push(name.clone());
            k += 1;
            if code.get(k) != Some(&Token::Mark(':')) || code.get(k + 1) != Some(&Token::Mark(':')) {
                break;
            }
            k += 2;
        }
        match named.len() {
            0 => k += 1,
            1 => {}
            _ => found.push(named),
        }
    }
    found
}

/// A path from the root of the crate; None when it begins elsewhere.
fn from_root(
    path: &[String],
    named: &[String],
    known: &BTreeMap<String, Vec<String>>,
) -> Option<Vec<String>> {
    let (first, mut rest) = named.split_first()?;
    let mut begin = match first.as_str() {
        "crate" => Vec::new(),
        "self" => path.to_vec(),
        "super" => path[..path.len().checked_sub(1)?].to_vec(),
        name => known.get(name)?.clone(),
    };
    while rest.first().is_some_and(|name| name == "super") {
        begin.pop();
        rest = &rest[1..];
    }
    Some([begin.as_slice(), rest].concat())
}
