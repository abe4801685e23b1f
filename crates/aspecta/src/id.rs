//! Numbers that say of what they are: one of an aspect cannot be taken for one of a region.

/// Declares such a number: `new($count)` makes one, `$count()` gives the number back, and it is printed and
/// serialised as that.
macro_rules! id {
    ($(#[$attribute:meta])* $name:ident, $count:ident) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
        #[serde(transparent)]
        pub struct $name(usize);

        impl $name {
            #[doc = concat!("The one with this ", stringify!($count), ".")]
            pub const fn new($count: usize) -> Self {
                Self($count)
            }

            #[doc = concat!("Returns its ", stringify!($count), ".")]
            pub const fn $count(self) -> usize {
                self.0
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.0.fmt(f)
            }
        }
    };
}

pub(crate) use id;
