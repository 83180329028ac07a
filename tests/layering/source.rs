//! Finds the paths in Rust source that may lead out of their module: those that start with `crate`, `super`, `self` or the
//! package's own name, and those that may start with the name of a crate. Comments and literals are left out.

use std::collections::HashSet;

/// A path in the source that may lead out of its module.
pub struct Reference<'a> {
    /// The module that it stands in, `scene::obj` say.
    pub from: String,
    pub target: Target<'a>,
    pub line: usize,
}

pub enum Target<'a> {
    /// A top module of this package; `*` stands for all of them.
    Module(&'a str),
    /// A crate, if there is one of that name.
    Name(&'a str),
    /// A crate for certain: written with a leading `::`.
    Crate(&'a str),
}

/// Every reference in a file. `module` is the file's own path, empty for the root of a crate.
pub fn references<'a>(source: &'a str, module: Vec<&'a str>) -> Vec<Reference<'a>> {
    let (words, blocks, found, local) = (words(source), Vec::new(), Vec::new(), HashSet::new());
    let mut reader = Reader { words, at: 0, module, blocks, depth: 0, found, local };
    while reader.at < reader.words.len() {
        reader.step();
    }
    let Reader { mut found, local, .. } = reader;
    found.retain(|reference| !matches!(reference.target, Target::Name(name) if local.contains(name)));
    found
}

/// Walks over the words of a file and collects its references.
struct Reader<'a> {
    words: Vec<Word<'a>>,
    at: usize,
    /// The module around the present word.
    module: Vec<&'a str>,
    /// How many braces are open.
    depth: usize,
    /// How many were open before each `mod name {` around the present word.
    blocks: Vec<usize>,
    found: Vec<Reference<'a>>,
    /// Modules declared here and names imported from this package: they hide a crate of the same name.
    local: HashSet<&'a str>,
}

impl<'a> Reader<'a> {
    /// The text of the word that stands `ahead` of the present one; empty past the end.
    fn word(&self, ahead: usize) -> &'a str {
        self.words.get(self.at + ahead).map_or("", |word| word.text)
    }

    fn step(&mut self) {
        match self.word(0) {
            "use" => {
                self.at += 1;
                self.path(Vec::new(), true);
            }
            "extern" if self.word(1) == "crate" => {
                self.at += 2;
                self.path(Vec::new(), true);
            }
            "mod" if is_name(self.word(1)) => self.declare_module(),
            "{" => {
                self.depth += 1;
                self.at += 1;
            }
            "}" => self.close_brace(),
            word if is_name(word) || word == "::" => self.path(Vec::new(), false),
            _ => self.at += 1,
        }
    }

    fn declare_module(&mut self) {
        let name = self.word(1);
        self.local.insert(name);
        if self.word(2) == "{" {
            self.module.push(name);
            self.blocks.push(self.depth);
        }
        self.at += 2;
    }

    fn close_brace(&mut self) {
        self.at += 1;
        self.depth = self.depth.saturating_sub(1);
        if self.blocks.last() == Some(&self.depth) {
            self.blocks.pop();
            self.module.pop();
        }
    }

    /// Reads a path, or a whole tree of them in a `use`, and records each leaf. `segments` leads up to here.
    fn path(&mut self, mut segments: Vec<&'a str>, in_use: bool) {
        let line = self.words.get(self.at).map_or(0, |word| word.line);
        let global = segments.is_empty() && self.word(0) == "::";
        self.at += usize::from(global);
        loop {
            match self.word(0) {
                "{" if in_use => return self.group(&segments),
                word if is_name(word) || (in_use && word == "*") => segments.push(word),
                _ => break,
            }
            self.at += 1;
            if self.word(0) != "::" || !(in_use || is_name(self.word(1))) {
                break;
            }
            self.at += 1;
        }
        if in_use && segments.len() > 1 && segments.last() == Some(&"self") {
            segments.pop();
        }
        let mut name = segments.last().copied().unwrap_or_default();
        if in_use && self.word(0) == "as" {
            name = self.word(1);
            self.at += 2;
        }
        // A lone name in an expression stays in the file, as `crate` in `pub(crate)` and the end of `Vec::<T>::new` do.
        if in_use || segments.len() > 1 {
            self.record(&segments, global, line);
        }
        if in_use && matches!(segments.first(), Some(&("crate" | "lightwell" | "self" | "super"))) {
            self.local.insert(name);
        }
    }

    /// The braces of a `use` tree.
    fn group(&mut self, segments: &[&'a str]) {
        self.at += 1;
        while !matches!(self.word(0), "}" | "") {
            let start = self.at;
            self.path(segments.to_vec(), true);
            if self.at == start || self.word(0) == "," {
                self.at += 1;
            }
        }
        self.at += 1;
    }

    fn record(&mut self, segments: &[&'a str], global: bool, line: usize) {
        let Some(&first) = segments.first() else { return };
        let supers = segments.iter().filter(|&&segment| segment == "super").count();
        let up = &self.module[..self.module.len().saturating_sub(supers)];
        let target = match first {
            _ if global => Target::Crate(first),
            "crate" | "lightwell" => Target::Module(segments.get(1).copied().unwrap_or("*")),
            "self" | "super" => {
                let down = segments.iter().find(|&&segment| !matches!(segment, "self" | "super"));
                Target::Module(up.first().or(down).copied().unwrap_or("*"))
            }
            _ => Target::Name(first),
        };
        self.found.push(Reference { from: self.module.join("::"), target, line });
    }
}

struct Word<'a> {
    text: &'a str,
    line: usize,
}

fn is_name(word: &str) -> bool {
    word.starts_with(is_letter) && !word.starts_with(|first: char| first.is_ascii_digit())
}

fn is_letter(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

/// Names, numbers and signs, without space, comments, lifetimes, characters and strings.
fn words(source: &str) -> Vec<Word<'_>> {
    let (mut words, mut rest, mut line) = (Vec::new(), source, 1);
    while let Some(first) = rest.chars().next() {
        let silent = silent_length(rest);
        let length = silent.unwrap_or_else(|| match first {
            _ if is_letter(first) => rest.find(|letter| !is_letter(letter)).unwrap_or(rest.len()),
            _ if ["::", "->", "=>"].iter().any(|sign| rest.starts_with(sign)) => 2,
            _ => first.len_utf8(),
        });
        let (text, after) = rest.split_at(length);
        if silent.is_none() {
            words.push(Word { text, line });
        }
        line += text.matches('\n').count();
        rest = after;
    }
    words
}

/// How many bytes at the front say nothing about names, if any.
fn silent_length(rest: &str) -> Option<usize> {
    let end = |found: Option<usize>| Some(found.unwrap_or(rest.len()));
    let first = rest.chars().next()?;
    match first {
        _ if first.is_whitespace() => Some(first.len_utf8()),
        '/' if rest.starts_with("//") => end(rest.find('\n')),
        '/' if rest.starts_with("/*") => end(comment_length(rest)),
        '"' => end(string_length(rest)),
        '\'' => quote_length(rest),
        'r' | 'b' | 'c' => raw_string_length(rest),
        _ => None,
    }
}

/// Block comments nest.
fn comment_length(rest: &str) -> Option<usize> {
    let mut open = 0;
    let mut at = 0;
    loop {
        let sign = at + rest[at..].find(['/', '*'])?;
        let step = match rest.get(sign..sign + 2) {
            Some("/*") => 1,
            Some("*/") => -1,
            _ => 0,
        };
        open += step;
        at = sign + if step == 0 { 1 } else { 2 };
        if open == 0 {
            return Some(at);
        }
    }
}

fn string_length(rest: &str) -> Option<usize> {
    let mut escaped = false;
    let closes = |(_, letter): &(usize, char)| {
        let closing = *letter == '"' && !escaped;
        escaped = *letter == '\\' && !escaped;
        closing
    };
    rest.char_indices().skip(1).find(closes).map(|(at, _)| at + 1)
}

/// A character, `'a'` or `'\n'`, or a lifetime, `'a`.
fn quote_length(rest: &str) -> Option<usize> {
    let mut letters = rest.char_indices().skip(1);
    let (_, first) = letters.next()?;
    match (first, letters.next()) {
        ('\\', Some((at, escaped))) => {
            let after = at + escaped.len_utf8();
            Some(after + rest[after..].find('\'')? + 1)
        }
        (_, Some((at, '\''))) => Some(at + 1),
        _ => Some(1 + rest[1..].find(|letter| !is_letter(letter)).unwrap_or(rest.len() - 1)),
    }
}

/// `r"…"`, `r#"…"#`, and the same for bytes and C strings.
fn raw_string_length(rest: &str) -> Option<usize> {
    let after = rest.strip_prefix("r").or_else(|| rest.strip_prefix("br")).or_else(|| rest.strip_prefix("cr"))?;
    let body = after.trim_start_matches('#');
    let hashes = &after[..after.len() - body.len()];
    let open = rest.len() - body.len() + 1;
    let close = format!("\"{hashes}");
    body.strip_prefix('"')?.find(&close).map(|at| open + at + close.len())
}
