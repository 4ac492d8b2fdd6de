//! Rewrites WGSL functions into the other languages, token by token, so that comments and layout stay.
//!
//! It knows the part of WGSL that the sources of the lookup use: functions, structs of numbers, `let` and `var` with a
//! type, `if`, `return`, calls, and the types `f32`, `i32`, `bool`, `vec2<f32>` and `vec3<f32>`. Vectors are only made
//! and read by component, so that languages without vector arithmetic can have them as structs.

use super::dialect::{Cast, Dialect};
use std::collections::BTreeSet;

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Space,
    Comment,
    Word,
    Number,
    Sign,
}

#[derive(Debug, Clone, Copy)]
struct Token<'a> {
    kind: Kind,
    text: &'a str,
}

fn tokens(source: &str) -> Vec<Token<'_>> {
    let mut rest = source;
    let mut tokens = Vec::new();
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let (kind, length) = if first.is_whitespace() {
            (Kind::Space, rest.find(|c: char| !c.is_whitespace()))
        } else if rest.starts_with("//") {
            (Kind::Comment, rest.find('\n'))
        } else if first.is_ascii_digit() {
            (Kind::Number, number_length(rest))
        } else if is_word(first) {
            (Kind::Word, rest.find(|c: char| !is_word(c)))
        } else if rest.starts_with("->") || rest.starts_with("::") {
            (Kind::Sign, Some(2))
        } else {
            (Kind::Sign, Some(first.len_utf8()))
        };
        let (text, after) = rest.split_at(length.unwrap_or(rest.len()));
        tokens.push(Token { kind, text });
        rest = after;
    }
    tokens
}

fn number_length(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    (0..bytes.len()).find(|&i| {
        let is_exponent_sign = matches!(bytes[i], b'-' | b'+') && matches!(bytes[i - 1], b'e');
        !(bytes[i].is_ascii_alphanumeric() || bytes[i] == b'.' || is_exponent_sign)
    })
}

/// `source` in the language of `dialect`. The names that `source` declares get the prefix `function` and an underscore,
/// except `lensed`, which becomes `function` itself.
///
/// # Panics
/// If `source` uses what this module does not know: the sources are part of the program.
pub fn rewrite(source: &str, dialect: &Dialect, function: &str) -> String {
    let tokens = tokens(source);
    let declared = declared(&tokens);
    let rewriter = Rewriter {
        dialect,
        function,
        declared: &declared,
    };
    rewriter.all(&tokens)
}

/// The names of the functions and structs that are declared.
fn declared<'a>(tokens: &[Token<'a>]) -> BTreeSet<&'a str> {
    let words: Vec<_> = tokens.iter().filter(|t| t.kind != Kind::Space).collect();
    let declarations = words
        .windows(2)
        .filter(|pair| matches!(pair[0].text, "fn" | "struct"));
    declarations.map(|pair| pair[1].text).collect()
}

struct Rewriter<'a> {
    dialect: &'a Dialect,
    function: &'a str,
    declared: &'a BTreeSet<&'a str>,
}

impl Rewriter<'_> {
    fn all(&self, tokens: &[Token]) -> String {
        let mut out = String::new();
        let mut at = 0;
        while at < tokens.len() {
            at = self.one(tokens, at, &mut out);
        }
        out
    }

    /// Rewrites the construct that begins at `at`, and returns where the next one begins.
    fn one(&self, tokens: &[Token], at: usize, out: &mut String) -> usize {
        let token = tokens[at];
        if self.dialect.is_wgsl() {
            *out += &self.renamed(tokens, at);
            return at + 1;
        }
        match (token.kind, token.text) {
            (Kind::Word, "fn") => self.function(tokens, at, out),
            (Kind::Word, "struct") => self.structure(tokens, at, out),
            (Kind::Word, "let" | "var") => self.variable(tokens, at, out),
            (Kind::Word, "select") => {
                let (arguments, end) = arguments(tokens, at + 1);
                let [no, yes, condition] = arguments.as_slice() else {
                    panic!("select of {} arguments", arguments.len());
                };
                let of_vectors = no.iter().any(|token| token.text == "vec2");
                let parts = [no, yes, condition].map(|part| self.all(part));
                let [no, yes, condition] = parts.each_ref().map(|part| part.trim());
                *out += &match self.dialect.choose_vec2.filter(|_| of_vectors) {
                    Some(choose) => format!("{choose}({no}, {yes}, {condition})"),
                    None => format!("({condition} ? {yes} : {no})"),
                };
                end
            }
            (Kind::Word, "f32" | "i32") if self.dialect.cast == Cast::Prefix => {
                *out += &format!("({})", self.dialect.type_name(token.text));
                at + 1
            }
            (Kind::Word, "vec2" | "vec3") => {
                *out += match token.text {
                    "vec2" => self.dialect.make_vec2,
                    _ => self.dialect.make_vec3,
                };
                after_type(tokens, at)
            }
            (Kind::Word, name) => {
                *out += &match self.dialect.type_or_builtin(name) {
                    Some(known) => known.to_owned(),
                    None => self.renamed(tokens, at),
                };
                at + 1
            }
            (Kind::Number, number) => {
                *out += number;
                if number.contains(['.', 'e']) {
                    *out += self.dialect.float_suffix;
                }
                at + 1
            }
            (_, text) => {
                *out += text;
                at + 1
            }
        }
    }

    /// The token at `at`, with the prefix if it is a name that the source declares. A parameter or a variable may be
    /// called as a function is, which is followed by a bracket.
    fn renamed(&self, tokens: &[Token], at: usize) -> String {
        let Token { kind, text } = tokens[at];
        let is_type = text.starts_with(|c: char| c.is_ascii_uppercase());
        let is_call = tokens.get(at + 1).is_some_and(|next| next.text == "(");
        match kind == Kind::Word && (is_type || is_call) && self.declared.contains(text) {
            true if text == "lensed" => self.function.to_owned(),
            true => format!("{}_{text}", self.function),
            false => text.to_owned(),
        }
    }

    /// `fn name(a: A, b: B) -> R` as `R name(A a, B b)`.
    fn function(&self, tokens: &[Token], at: usize, out: &mut String) -> usize {
        let name = self.renamed(tokens, at + 2);
        let (parameters, mut end) = arguments(tokens, at + 3);
        let mut parameters: Vec<_> = parameters
            .iter()
            .map(|parameter| self.declaration(parameter))
            .collect();
        if parameters.is_empty() {
            parameters.push(self.dialect.no_parameters.to_owned());
        }
        while tokens[end].text != "->" {
            end += 1;
        }
        let (result, end) = self.type_at(tokens, end + 2);
        *out += &format!(
            "{}{result} {name}({})",
            self.dialect.function_prefix,
            parameters.join(", ")
        );
        end
    }

    /// `name: T` as `T name`. A parameter without a type is in the other language already.
    fn declaration(&self, tokens: &[Token]) -> String {
        let words: Vec<_> = tokens
            .iter()
            .copied()
            .filter(|token| token.kind != Kind::Space)
            .collect();
        if words.get(1).is_none_or(|colon| colon.text != ":") {
            let text: String = tokens.iter().map(|token| token.text).collect();
            return text.trim().to_owned();
        }
        let name = words[0];
        let (kind, _) = self.type_at(&words, 2);
        format!("{kind} {}", name.text)
    }

    fn structure(&self, tokens: &[Token], at: usize, out: &mut String) -> usize {
        let name = self.renamed(tokens, at + 2);
        let end = at
            + tokens[at..]
                .iter()
                .position(|token| token.text == "}")
                .expect("a struct ends");
        let (open, close) = match self.dialect.typedef {
            true => ("typedef struct {".to_owned(), format!("}} {name};")),
            false => (format!("struct {name} {{"), "};".to_owned()),
        };
        *out += &open;
        let mut i = at + 1 + tokens[at + 1..].iter().position(|t| t.text == "{").unwrap() + 1;
        while i < end {
            let token = tokens[i];
            if token.kind == Kind::Word {
                let field = i..i + tokens[i..].iter().position(|t| t.text == ",").unwrap();
                *out += &self.declaration(&tokens[field.clone()]);
                *out += ";";
                i = field.end + 1;
            } else {
                *out += token.text;
                i += 1;
            }
        }
        *out += &close;
        end + 1
    }

    /// `let name: T` and `var name: T` as `T name`.
    fn variable(&self, tokens: &[Token], at: usize, out: &mut String) -> usize {
        let name = tokens[at + 2].text;
        assert_eq!(tokens[at + 3].text, ":", "{name} has no type");
        let (kind, end) = self.type_at(tokens, at + 5);
        *out += &format!("{kind} {name}");
        end
    }

    /// The type that begins at `at`, and where it ends.
    fn type_at(&self, tokens: &[Token], at: usize) -> (String, usize) {
        let end = after_type(tokens, at);
        let kind = match self.dialect.type_or_builtin(tokens[at].text) {
            Some(known) => known.to_owned(),
            None => self.renamed(tokens, at),
        };
        (kind, end)
    }
}

/// The index after the type that begins at `at`, which may have a parameter in `<>`.
fn after_type(tokens: &[Token], at: usize) -> usize {
    match tokens.get(at + 1) {
        Some(open) if open.text == "<" => {
            at + 1 + tokens[at + 1..].iter().position(|t| t.text == ">").unwrap() + 1
        }
        _ => at + 1,
    }
}

/// The arguments in the brackets that open at `open`, and the index after those.
fn arguments<'a, 'b>(tokens: &'b [Token<'a>], open: usize) -> (Vec<&'b [Token<'a>]>, usize) {
    assert_eq!(tokens[open].text, "(");
    let (mut depth, mut start, mut parts) = (0, open + 1, Vec::new());
    for (i, token) in tokens.iter().enumerate().skip(open) {
        match token.text {
            "(" => depth += 1,
            ")" => depth -= 1,
            _ => {}
        }
        let ends = depth == 0;
        if (ends && start < i) || (depth == 1 && token.text == ",") {
            parts.push(&tokens[start..i]);
            start = i + 1;
        }
        if ends {
            return (parts, i + 1);
        }
    }
    panic!("a bracket is not closed");
}

#[cfg(test)]
mod tests {
    use super::super::dialect::{C, GLSL, HLSL, OSL, WGSL};
    use super::*;

    const SOURCE: &str = "// A pair.
struct Pair {
    // The first.
    a: f32,
    b: i32,
}

fn sum(pair: Pair, sum: vec2<f32>) -> f32 {
    let largest: f32 = max(sum.x, select(1e-3, f32(pair.b), pair.a >= 2.0));
    if (largest > 1.5) {
        return -largest;
    }
    return select(select(1.0, 2.0, largest < 0.0), vec2<f32>(3.0, 4.0).x, pair.b == 1);
}

fn lensed() -> f32 {
    var pair: Pair;
    return sum(pair, vec2<f32>(1.0, 2.0));
}
";

    #[test]
    fn types_functions_and_selections_are_rewritten() {
        let glsl = rewrite(SOURCE, &GLSL, "bent");
        for line in [
            "// A pair.",
            "struct bent_Pair {",
            "    // The first.",
            "    float a;",
            "    int b;",
            "};",
            "float bent_sum(bent_Pair pair, vec2 sum) {",
            "    float largest = max(sum.x, (pair.a >= 2.0 ? float(pair.b) : 1e-3));",
            "    return (pair.b == 1 ? vec2(3.0, 4.0).x : (largest < 0.0 ? 2.0 : 1.0));",
            "float bent() {",
            "    bent_Pair pair;",
            "    return bent_sum(pair, vec2(1.0, 2.0));",
        ] {
            assert!(glsl.lines().any(|own| own == line), "{line}\n{glsl}");
        }
    }

    #[test]
    fn each_language_has_its_own_types_and_numbers() {
        for (dialect, lines) in [
            (&HLSL, &["float bent_sum(bent_Pair pair, float2 sum) {"][..]),
            (
                &OSL,
                &["float bent_sum(bent_Pair pair, $function_vec2 sum) {"],
            ),
            (
                &C,
                &[
                    "typedef struct {",
                    "} bent_Pair;",
                    "static inline float bent_sum(bent_Pair pair, $function_vec2 sum) {",
                    "    float largest = fmaxf(sum.x, (pair.a >= 2.0f ? (float)(pair.b) : 1e-3f));",
                    "static inline float bent(void) {",
                ],
            ),
            (
                &WGSL,
                &[
                    "fn bent_sum(pair: bent_Pair, sum: vec2<f32>) -> f32 {",
                    "fn bent() -> f32 {",
                ],
            ),
        ] {
            let text = rewrite(SOURCE, dialect, "bent");
            for line in lines {
                assert!(text.lines().any(|own| own == *line), "{line}\n{text}");
            }
        }
    }

    #[test]
    #[should_panic(expected = "has no type")]
    fn a_variable_without_a_type_is_refused() {
        rewrite("fn f() -> f32 { let x = 1.0; return x; }", &GLSL, "f");
    }
}
