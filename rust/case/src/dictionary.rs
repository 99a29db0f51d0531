//! Reads OpenFOAM dictionaries as `foamDictionary -expand` prints them. OpenFOAM itself resolves includes, macros and entries
//! that replace others, so only keys, values and nested dictionaries are left to be read.

use crate::{CaseError, openfoam};
use regex_lite::Regex;
use std::path::{Path, PathBuf};

/// One word, string or bracket.
#[derive(Clone, Debug, PartialEq)]
pub struct Token {
    pub text: String,
    /// Written in double quotes; such a key is a regular expression.
    pub quoted: bool,
    line: usize,
}

/// What a key stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum Entry {
    Value(Vec<Token>),
    Dictionary(Dictionary),
}

/// Keys and what they stand for, in the order of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Dictionary {
    /// The file, for messages.
    pub file: PathBuf,
    /// Keys of the enclosing dictionaries, joined by '/'.
    path: String,
    entries: Vec<(Token, Entry)>,
}

impl Dictionary {
    /// Reads a file of a case through `foamDictionary -expand`; a binary file, which that cannot read and a program has written, by itself.
    ///
    /// # Errors
    /// [`CaseError::Read`] with what OpenFOAM says; [`CaseError::Syntax`].
    pub fn expanded(file: &Path) -> Result<Self, CaseError> {
        if let Some(text) = crate::binary::text_of(file) {
            return Self::parse(file, &text);
        }
        let failed = |problem: String| CaseError::Read { file: file.to_path_buf(), problem };
        let mut command = openfoam::command(Path::new("foamDictionary"));
        command.arg("-expand");
        if let Some(case) = case_of(file) {
            // Else $FOAM_CASE and <case> in the file stand for the folder of this process
            command.arg("-case").arg(case);
        }
        command.arg(file);
        let output = command
            .output()
            .map_err(|error| failed(format!("foamDictionary: {error} (scripts/setup installs OpenFOAM)")))?;
        if !output.status.success() {
            let text = String::from_utf8_lossy(&output.stderr);
            let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
            let said = if lines.is_empty() {
                "no message; does the file include itself?".into()
            } else {
                lines.join(" ")
            };
            return Err(failed(format!("foamDictionary ended with {}: {said}", output.status)));
        }
        Self::parse(file, &String::from_utf8_lossy(&output.stdout))
    }

    /// Reads expanded text; `file` is for messages.
    ///
    /// # Errors
    /// [`CaseError::Syntax`] with the line of the text.
    pub fn parse(file: &Path, text: &str) -> Result<Self, CaseError> {
        let tokens = tokens(text);
        let mut reader = Reader { file, tokens: &tokens, at: 0 };
        let dictionary = reader.dictionary(String::new())?;
        match reader.next() {
            None => Ok(dictionary),
            Some(token) => Err(reader.syntax(token.line, "'}' without '{'")),
        }
    }

    pub fn keys(&self) -> impl Iterator<Item = &Token> {
        self.entries.iter().map(|(key, _)| key)
    }

    /// The entry of exactly this key.
    pub fn get(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|(name, _)| !name.quoted && name.text == key).map(|(_, entry)| entry)
    }

    /// The entry with this key, which may stand in quotes.
    pub fn get_any(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|(name, _)| name.text == key).map(|(_, entry)| entry)
    }

    /// The entry that OpenFOAM uses for a key: that of the key itself, else that of the last pattern that matches it.
    pub fn matching(&self, key: &str) -> Option<&Entry> {
        let pattern = || self.entries.iter().rev().find(|(name, _)| name.quoted && name.matches(key));
        self.get(key).or_else(|| pattern().map(|(_, entry)| entry))
    }

    /// A nested dictionary.
    ///
    /// # Errors
    /// [`CaseError::Key`] when it is missing or a value.
    pub fn dictionary_at(&self, key: &str) -> Result<&Self, CaseError> {
        match self.get(key) {
            Some(Entry::Dictionary(dictionary)) => Ok(dictionary),
            _ => Err(self.refuse(key, "missing", "a dictionary")),
        }
    }

    /// The tokens of a value.
    ///
    /// # Errors
    /// [`CaseError::Key`] when it is missing or a dictionary.
    pub fn value(&self, key: &str) -> Result<&[Token], CaseError> {
        match self.get(key) {
            Some(Entry::Value(tokens)) => Ok(tokens),
            Some(Entry::Dictionary(_)) => Err(self.refuse(key, "{...}", "a value")),
            None => Err(self.refuse(key, "missing", "a value")),
        }
    }

    /// The tokens of a value joined by spaces.
    ///
    /// # Errors
    /// Those of [`Dictionary::value`].
    pub fn text(&self, key: &str) -> Result<String, CaseError> {
        Ok(joined(self.value(key)?))
    }

    /// A number that `good` accepts.
    ///
    /// # Errors
    /// [`CaseError::Key`] with what is allowed.
    pub fn number(&self, key: &str, good: impl Fn(f64) -> bool, allowed: &str) -> Result<f64, CaseError> {
        let tokens = self.value(key)?;
        self.number_in(key, tokens, good, allowed)
    }

    /// A finite number, or the usual one where the key is missing.
    ///
    /// # Errors
    /// Those of [`Dictionary::number`].
    pub fn number_or(&self, key: &str, usual: f64) -> Result<f64, CaseError> {
        match self.get(key) {
            Some(_) => self.number(key, f64::is_finite, "a number"),
            None => Ok(usual),
        }
    }

    /// The number of a value `uniform <number>`.
    ///
    /// # Errors
    /// [`CaseError::Key`] for anything else.
    pub fn uniform(&self, key: &str) -> Result<f64, CaseError> {
        match self.value(key)? {
            [word, number @ ..] if word.text == "uniform" => {
                self.number_in(key, number, f64::is_finite, "uniform <number>")
            }
            other => Err(self.refuse(key, &joined(other), "uniform <number>")),
        }
    }

    /// The mean over the cells of a scalar field: of `uniform <number>`, or of `nonuniform` with its list.
    ///
    /// # Errors
    /// [`CaseError::Key`] for anything else.
    pub fn mean(&self, key: &str) -> Result<f64, CaseError> {
        self.means::<1>(key).map(|[mean]| mean)
    }

    /// The means over the cells of the components of a field.
    ///
    /// # Errors
    /// As [`Self::mean`].
    pub fn means<const N: usize>(&self, key: &str) -> Result<[f64; N], CaseError> {
        let tokens = self.value(key)?;
        let (values, most) = match tokens {
            // The kind of the list and its length stand before the values.
            [word, _, _, rest @ ..] if word.text == "nonuniform" => (rest, usize::MAX),
            [word, rest @ ..] if word.text == "uniform" => (rest, N),
            _ => return Err(self.refuse(key, &joined(tokens), "uniform <value>, or a list")),
        };
        let numbers: Vec<f64> = values.iter().filter_map(|token| token.text.parse().ok()).collect();
        let complete = (N..=most).contains(&numbers.len()) && numbers.len().is_multiple_of(N);
        let mut means = [0.0; N];
        for (k, number) in numbers.iter().enumerate() {
            means[k % N] += number / (numbers.len() / N) as f64;
        }
        match complete && means.iter().all(|mean| mean.is_finite()) {
            true => Ok(means),
            false => Err(self.refuse(key, &joined(tokens), "a list of finite numbers")),
        }
    }

    fn number_in(
        &self,
        key: &str,
        tokens: &[Token],
        good: impl Fn(f64) -> bool,
        allowed: &str,
    ) -> Result<f64, CaseError> {
        let number = match tokens {
            [token] => token.text.parse().ok().filter(|&number| good(number)),
            _ => None,
        };
        number.ok_or_else(|| self.refuse(key, &joined(tokens), allowed))
    }

    /// Refuses every key that is not in one of the lists.
    ///
    /// # Errors
    /// [`CaseError::Key`] with the first such key.
    pub fn check_keys(&self, known: &[&[&str]]) -> Result<(), CaseError> {
        let is_known = |key: &Token| known.iter().any(|list| list.contains(&key.text.as_str()));
        match self.entries.iter().find(|(key, _)| !is_known(key)) {
            None => Ok(()),
            Some((key, entry)) => {
                let value = match entry {
                    Entry::Value(tokens) => joined(tokens),
                    Entry::Dictionary(_) => "{...}".to_string(),
                };
                Err(self.refuse(&key.text, &value, &format!("the keys {}", known.concat().join(", "))))
            }
        }
    }

    /// A key of this dictionary with the keys of the enclosing dictionaries in front, joined by '/'.
    pub fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_string() } else { format!("{}/{key}", self.path) }
    }

    /// The error for a key of this dictionary whose value is not allowed.
    pub fn refuse(&self, key: &str, value: &str, allowed: &str) -> CaseError {
        CaseError::Key {
            file: self.file.clone(),
            key: self.path_of(key),
            value: value.to_string(),
            allowed: allowed.to_string(),
        }
    }
}

impl Token {
    /// Whether this pattern matches the whole of `key`.
    pub fn matches(&self, key: &str) -> bool {
        Regex::new(&format!("^(?:{})$", self.text)).is_ok_and(|pattern| pattern.is_match(key))
    }
}

/// The folder of the case that a file is in: the nearest around it with a folder `system`.
fn case_of(file: &Path) -> Option<PathBuf> {
    let file = std::path::absolute(file).ok()?;
    file.ancestors().skip(1).find(|folder| folder.join("system").is_dir()).map(Path::to_path_buf)
}

/// Tokens as text.
pub fn joined(tokens: &[Token]) -> String {
    tokens.iter().map(|token| token.text.as_str()).collect::<Vec<_>>().join(" ")
}

struct Reader<'a> {
    file: &'a Path,
    tokens: &'a [Token],
    at: usize,
}

impl<'a> Reader<'a> {
    fn next(&mut self) -> Option<&'a Token> {
        self.at += 1;
        self.tokens.get(self.at - 1)
    }

    fn syntax(&self, line: usize, problem: &str) -> CaseError {
        CaseError::Syntax { file: self.file.to_path_buf(), line, problem: problem.to_string() }
    }

    /// Entries up to the closing brace, or the end of the outermost dictionary.
    fn dictionary(&mut self, path: String) -> Result<Dictionary, CaseError> {
        let mut entries = Vec::new();
        while let Some(key) = self.tokens.get(self.at) {
            if !key.quoted && key.text == "}" {
                break;
            }
            self.at += 1;
            if !key.quoted && ["{", "(", ")", "[", "]", ";"].contains(&key.text.as_str()) {
                return Err(self.syntax(key.line, &format!("'{}' where a key should be", key.text)));
            }
            let entry = self.entry(key, &path)?;
            entries.push((key.clone(), entry));
        }
        Ok(Dictionary { file: self.file.to_path_buf(), path, entries })
    }

    fn entry(&mut self, key: &Token, path: &str) -> Result<Entry, CaseError> {
        if self.tokens.get(self.at).is_some_and(|token| !token.quoted && token.text == "{") {
            self.at += 1;
            let path = if path.is_empty() { key.text.clone() } else { format!("{path}/{}", key.text) };
            let dictionary = self.dictionary(path)?;
            return match self.next() {
                Some(_) => Ok(Entry::Dictionary(dictionary)),
                None => Err(self.syntax(key.line, &format!("'{}' is not closed", key.text))),
            };
        }
        let (mut value, mut depth) = (Vec::new(), 0);
        while let Some(token) = self.next() {
            match token.text.as_str() {
                _ if token.quoted => {}
                ";" if depth == 0 => return Ok(Entry::Value(value)),
                "(" => depth += 1,
                ")" => depth -= 1,
                _ => {}
            }
            value.push(token.clone());
        }
        Err(self.syntax(key.line, &format!("'{}' has no ';'", key.text)))
    }
}

/// Words, strings and brackets of a text, without comments.
fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let (mut rest, mut line) = (text, 1);
    while let Some(first) = rest.chars().next() {
        let length = match first {
            _ if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            _ if rest.starts_with("/*") => rest.find("*/").map_or(rest.len(), |end| end + 2),
            '"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            '{' | '}' | '(' | ')' | '[' | ']' | ';' => 1,
            _ if first.is_whitespace() => first.len_utf8(),
            _ => rest.find(|c: char| c.is_whitespace() || "{}()[];\"".contains(c)).unwrap_or(rest.len()),
        };
        let (token, after) = rest.split_at(length);
        let comment = token.starts_with("//") || token.starts_with("/*");
        if !comment && !first.is_whitespace() {
            let (text, quoted) = (token.trim_matches('"').to_string(), first == '"');
            tokens.push(Token { text, quoted, line });
        }
        line += token.matches('\n').count();
        rest = after;
    }
    tokens
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Dictionary, CaseError> {
        Dictionary::parse(Path::new("0/T"), text)
    }

    #[test]
    fn values_lists_nested_dictionaries_and_means_of_fields() {
        let dictionary = parse(
            "/* head */ a 1e+07; // note\n list ( ( 1 2 ) { x y ; } ); inner { deep { b uniform 3; } \"p|q\" { c d; } }
             f uniform 3; g nonuniform List<scalar> 2 ( 1 2 ); h nonuniform List<scalar> 9 { 4 }; none nonuniform List<scalar> 0 ( );
             s nonuniform List<symmTensor> 2 ( ( 1 2 3 4 5 6 ) ( 3 2 3 4 5 8 ) );",
        )
        .unwrap();
        assert_eq!(dictionary.number("a", |v| v > 0.0, "> 0").unwrap(), 1e7);
        assert_eq!(dictionary.text("list").unwrap(), "( ( 1 2 ) { x y ; } )");
        let inner = dictionary.dictionary_at("inner").unwrap();
        assert_eq!(inner.dictionary_at("deep").unwrap().uniform("b").unwrap(), 3.0);
        assert!(inner.get("q").is_none() && inner.matching("q").is_some() && inner.matching("pq").is_none());
        assert_eq!(["f", "g", "h"].map(|key| dictionary.mean(key).unwrap()), [3.0, 1.5, 4.0]);
        assert!(
            dictionary.mean("none").unwrap_err().to_string().contains("allowed: a list of finite numbers")
        );
        assert_eq!(dictionary.means("s").unwrap(), [2.0, 2.0, 3.0, 4.0, 5.0, 7.0]);
    }

    #[test]
    fn includes_stand_in_the_case_of_the_file() {
        let case = std::env::temp_dir().join(format!("msdd-included-{}", std::process::id()));
        std::fs::create_dir_all(case.join("system")).unwrap();
        let write = |file: &str, text: &str| msdd_files::write(&case.join(file), text.as_bytes()).unwrap();
        write("constant/hot", "hot 360;");
        write("constant/cold", "cold 290;");
        let include = "#include \"$FOAM_CASE/constant/hot\"\n#include \"<case>/constant/cold\"\n";
        write("0/bed/T", &format!("{include} value ($hot $cold);"));
        let read = Dictionary::expanded(&case.join("0/bed/T")).unwrap();
        assert_eq!(read.text("value").unwrap(), "( 360 290 )");
        std::fs::remove_dir_all(&case).unwrap();
    }

    #[test]
    fn errors_name_file_key_value_and_what_is_allowed() {
        let dictionary = parse("a { b nonuniform 3; }").unwrap();
        let error = dictionary.dictionary_at("a").unwrap().uniform("b").unwrap_err();
        assert_eq!(error.to_string(), "0/T: a/b = nonuniform 3, allowed: uniform <number>");
        for (text, message) in [
            ("a 1", "0/T: line 1: 'a' has no ';'"),
            ("a {\n b 1;", "0/T: line 1: 'a' is not closed"),
            ("a 1;\n}", "0/T: line 2: '}' without '{'"),
            ("( a );", "0/T: line 1: '(' where a key should be"),
            ("e { }", "0/T: e = {...}, allowed: the keys c, d"),
        ] {
            let error = parse(text).and_then(|read| read.check_keys(&[&["c"], &["d"]])).unwrap_err();
            assert_eq!(error.to_string(), message);
        }
    }
}
