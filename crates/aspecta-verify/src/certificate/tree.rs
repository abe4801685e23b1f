//! Trees of boxes as text.

use aspecta_robot::{ClassSet, MAX_BOXES};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt::Write;

/// Greatest depth of a tree.
pub const DEEPEST: u32 = 30;

/// The claims about one box, class by class (the bits of a [`ClassSet`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Leaf {
    /// The closed box lies in S_{s,σ}.
    pub inside: ClassSet,
    /// Nothing is claimed. A class in neither set is outside: box and S_{s,σ} are disjoint.
    pub undecided: ClassSet,
    /// No aspect of the class is highest in this box.
    pub summitless: ClassSet,
    /// The chart of a fold covers all configurations of the box.
    pub covered: bool,
}

/// An entry of a tree in preorder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// A box cut into 2^M equal children, which follow; child c lies in the upper half of axis a if bit a of
    /// c is set.
    Split,
    /// A box that is not cut.
    Leaf(Leaf),
}

/// A window cut into boxes: a tree in preorder.
///
/// As text, a split is `+`; a leaf is `*` if covered, then `inside:undecided:summitless` in hexadecimal,
/// where zeros and then trailing colons are left out, then `;`. So `;` is a box outside of everything, and
/// `+4;;:1;*:3:2;` is a window in four.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tree(pub Vec<Entry>);

/// Why a text is no tree.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TreeError {
    /// An unknown sign.
    #[error("`{sign}` at character {at} of the tree is not understood")]
    Sign {
        /// The character.
        sign: char,
        /// Its place, from 1.
        at: usize,
    },
    /// The text ends within a leaf.
    #[error("the tree ends within a leaf")]
    OpenLeaf,
    /// Not every split has its children, or something follows the last leaf.
    #[error("the tree has {found} entries, which do not make a tree whose every box is cut into {children}")]
    Shape {
        /// Entries in the text.
        found: usize,
        /// 2^M.
        children: usize,
    },
    /// Cut too often.
    #[error("the tree is deeper than {DEEPEST}")]
    Depth,
    /// Too large to hold.
    #[error("the tree has more than {MAX_BOXES} entries")]
    Size,
    /// Bits of classes there are not.
    #[error("leaf {leaf} of the tree speaks of classes beyond the {classes} there are")]
    Class {
        /// Number of the leaf, from 0 in the order of the text.
        leaf: usize,
        /// Number of classes.
        classes: usize,
    },
}

impl Tree {
    /// Whether the entries make a tree whose every split has 2^`axes` children, with claims on `classes`
    /// classes.
    ///
    /// # Errors
    /// [`TreeError`]
    pub fn check(&self, axes: usize, classes: usize) -> Result<(), TreeError> {
        let children = 1usize << axes;
        let shape = TreeError::Shape { found: self.0.len(), children };
        // How many boxes are still to come, by depth.
        let mut open = vec![1usize];
        let mut leaf = 0;
        for entry in &self.0 {
            while open.last() == Some(&0) {
                open.pop();
            }
            *open.last_mut().ok_or(shape.clone())? -= 1;
            match entry {
                Entry::Split if open.len() > DEEPEST as usize => return Err(TreeError::Depth),
                Entry::Split => open.push(children),
                Entry::Leaf(claims) => {
                    let all = claims.inside | claims.undecided | claims.summitless;
                    if u32::from(all) >> classes != 0 {
                        return Err(TreeError::Class { leaf, classes });
                    }
                    leaf += 1;
                }
            }
        }
        if open.iter().all(|&n| n == 0) { Ok(()) } else { Err(shape) }
    }

    fn parse(text: &str) -> Result<Self, TreeError> {
        let mut entries = Vec::new();
        let mut leaf: Option<(Leaf, usize)> = None;
        for (at, sign) in (1..).zip(text.chars()) {
            let unknown = TreeError::Sign { sign, at };
            match sign {
                '+' if leaf.is_none() => entries.push(Entry::Split),
                '*' if leaf.is_none() => leaf = Some((Leaf { covered: true, ..Leaf::default() }, 0)),
                ';' => entries.push(Entry::Leaf(leaf.take().unwrap_or_default().0)),
                ':' => {
                    let (_, field) = leaf.get_or_insert_default();
                    *field += 1;
                    if *field > 2 {
                        return Err(unknown);
                    }
                }
                digit => {
                    let value = digit.to_digit(16).ok_or(unknown.clone())? as ClassSet;
                    let (leaf, field) = leaf.get_or_insert_default();
                    let set = [&mut leaf.inside, &mut leaf.undecided, &mut leaf.summitless];
                    let set = set.into_iter().nth(*field).ok_or(unknown.clone())?;
                    *set = set.checked_mul(16).ok_or(unknown)? | value;
                }
            }
            if entries.len() as u64 > MAX_BOXES {
                return Err(TreeError::Size);
            }
        }
        if leaf.is_some() { Err(TreeError::OpenLeaf) } else { Ok(Self(entries)) }
    }

    fn text(&self) -> String {
        let mut text = String::new();
        for entry in &self.0 {
            let Entry::Leaf(leaf) = entry else {
                text.push('+');
                continue;
            };
            if leaf.covered {
                text.push('*');
            }
            let fields = [leaf.inside, leaf.undecided, leaf.summitless];
            let used = fields.iter().rposition(|set| *set != 0).map_or(0, |last| last + 1);
            for (k, set) in fields[..used].iter().enumerate() {
                if k > 0 {
                    text.push(':');
                }
                if *set != 0 {
                    // Writing to a String does not fail.
                    let _ = write!(text, "{set:x}");
                }
            }
            text.push(';');
        }
        text
    }
}

impl Serialize for Tree {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text())
    }
}

impl<'de> Deserialize<'de> for Tree {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::parse(&String::deserialize(deserializer)?).map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn texts_that_are_no_trees_are_refused() {
        for (text, error) in [
            ("+;;;", TreeError::Shape { found: 4, children: 4 }),
            ("+;;;;;", TreeError::Shape { found: 6, children: 4 }),
            ("", TreeError::Shape { found: 0, children: 4 }),
            ("10;", TreeError::Class { leaf: 0, classes: 4 }),
        ] {
            assert_eq!(Tree::parse(text).unwrap().check(2, 4), Err(error), "{text}");
        }
        assert_eq!(Tree::parse(&"+".repeat(31)).unwrap().check(2, 4), Err(TreeError::Depth));
        assert_eq!(Tree::parse("+1"), Err(TreeError::OpenLeaf));
        assert_eq!(Tree::parse("+x"), Err(TreeError::Sign { sign: 'x', at: 2 }));
        for text in ["10000;", "1:2:3:4;", "1*;", "1+;"] {
            assert!(matches!(Tree::parse(text), Err(TreeError::Sign { .. })), "{text}");
        }
        assert_eq!(Tree::parse("+4;;:1;*:3:2;").unwrap().check(2, 4), Ok(()));
    }

    proptest! {
        #[test]
        fn text_and_back(bits in prop::collection::vec((any::<u16>(), any::<u16>(), any::<u16>(), any::<bool>(), any::<bool>()), 0..40)) {
            let entry = |&(inside, undecided, summitless, covered, split): &(u16, u16, u16, bool, bool)| {
                if split { Entry::Split } else { Entry::Leaf(Leaf { inside, undecided, summitless, covered }) }
            };
            let tree = Tree(bits.iter().map(entry).collect());
            prop_assert_eq!(Tree::parse(&tree.text()).unwrap(), tree);
        }
    }
}
