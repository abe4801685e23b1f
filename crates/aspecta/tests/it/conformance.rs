//! The page docs/conformance.md against the sources: what the paper numbers has a row, and a row names what exists.

use std::fs;
use std::path::{Path, PathBuf};

/// A row of a table of the page: a number of the paper, and the paths given for it.
struct Row {
    number: String,
    items: Vec<String>,
    tests: Vec<String>,
}

#[test]
fn every_number_of_the_paper_has_a_row() {
    let rows = rows();
    let numbers: Vec<&str> = rows.iter().map(|row| row.number.as_str()).collect();
    let wanted = |name: &'static str, last: usize| (1..=last).map(move |k| format!("{name} {k}"));
    let equations = (1..=18).map(|k| format!("({k})"));
    let all = wanted("Definition", 11).chain(wanted("Theorem", 3)).chain(equations);
    let all: Vec<String> = all.chain(wanted("Table", 4)).chain(wanted("Figure", 15)).collect();
    assert_eq!(numbers, all);
}

#[test]
fn what_rows_name_exists() {
    for row in rows() {
        assert!(!row.items.is_empty() && !row.tests.is_empty(), "{} names nothing", row.number);
        for item in &row.items {
            assert!(item_exists(item), "{}: no item `{item}`", row.number);
        }
        for test in &row.tests {
            assert!(test_exists(test), "{}: no test `{test}`", row.number);
        }
    }
}

#[test]
fn wrong_names_are_caught() {
    assert!(item_exists("aspecta::aspect::AspectClass") && !item_exists("aspecta::aspect::AspectClasses"));
    assert!(!item_exists("aspecta::domain::AspectClass"), "another module");
    assert!(!item_exists("aspecta_robot::AspectClass"), "another crate");
    assert!(!item_exists("aspecta::aspect::AspectClass::determinant"), "no such member");
    assert!(test_exists("aspecta::paper::table_1_signs_of_b") && !test_exists("aspecta::paper::table_1"));
    assert!(!test_exists("aspecta::paper::five_bar"), "a function that is no test");
    assert!(!test_exists("aspecta::aspects::table_1_signs_of_b"), "another file");
}

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

fn rows() -> Vec<Row> {
    let page = fs::read_to_string(crates().parent().unwrap().join("docs/conformance.md")).unwrap();
    let paths = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect();
    page.lines()
        .filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"))
        .filter(|line| !line.starts_with("number |"))
        .map(|line| match line.split(" | ").collect::<Vec<_>>()[..] {
            [number, _, items, tests] => {
                Row { number: number.into(), items: paths(items), tests: paths(tests) }
            }
            _ => panic!("four columns are wanted: {line}"),
        })
        .collect()
}

/// Whether `crate::modules::Item`, or `crate::modules::Type::member`, is declared in a file of those modules.
fn item_exists(path: &str) -> bool {
    let parts: Vec<&str> = path.split("::").collect();
    let [package, modules @ .., name] = &parts[..] else { return false };
    let (modules, owner) = match modules {
        [modules @ .., owner] if owner.starts_with(char::is_uppercase) => (modules, Some(*owner)),
        _ => (modules, None),
    };
    let root = crates().join(package.replace('_', "-")).join("src").join(modules.join("/"));
    let mut files = rust_files(&root);
    files.push(root.with_extension("rs"));
    files.iter().filter_map(|file| fs::read_to_string(file).ok()).any(|text| {
        text.lines().any(|line| declares(line, name)) && owner.is_none_or(|owner| has_word(&text, owner))
    })
}

/// Whether a line declares `name`: an item, or a public field.
fn declares(line: &str, name: &str) -> bool {
    let words: Vec<&str> = line.trim_start().splitn(4, ' ').collect();
    let words = if words[0].starts_with("pub") { &words[1..] } else { &words[..] };
    let named = |word: &str| word.split(|c: char| !is_of_a_name(c)).next() == Some(name);
    match words {
        ["const", "fn", word, ..] | ["struct" | "enum" | "trait" | "fn" | "const", word, ..] => named(word),
        [word, ..] => line.trim_start().starts_with("pub ") && word.strip_suffix(':') == Some(name),
        [] => false,
    }
}

fn has_word(text: &str, word: &str) -> bool {
    text.split(|c: char| !is_of_a_name(c)).any(|found| found == word)
}

fn is_of_a_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether `crate::file::function` is a test: a function under `#[test]` in a file of that name.
fn test_exists(path: &str) -> bool {
    let [package, file, function] = path.split("::").collect::<Vec<_>>()[..] else { return false };
    rust_files(&crates().join(package.replace('_', "-")))
        .iter()
        .filter(|found| found.file_stem().is_some_and(|stem| stem == file))
        .any(|found| has_test(&fs::read_to_string(found).unwrap(), function))
}

fn has_test(text: &str, function: &str) -> bool {
    text.split("#[test]").skip(1).any(|after| {
        after.lines().find(|line| line.contains("fn ")).is_some_and(|line| declares(line, function))
    })
}

/// Returns the Rust files in a directory and below; none if there is no such directory.
fn rust_files(directory: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(directory).into_iter().flatten().map(|entry| entry.unwrap().path());
    let files = entries.flat_map(|path| if path.is_dir() { rust_files(&path) } else { vec![path] });
    files.filter(|path| path.extension().is_some_and(|ending| ending == "rs")).collect()
}
