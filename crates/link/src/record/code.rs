//! Enums that cross processes as a 32-bit code.

/// A set of codes known to this version.
pub(crate) trait Code: Copy + 'static {
    /// The value of a code, if it is known.
    fn known(code: u32) -> Option<Self>;
}

/// Declares an enum with explicit codes and the checked conversion from a code.
macro_rules! coded {
    ($(#[$meta:meta])* $vis:vis enum $name:ident { $($(#[$doc:meta])* $variant:ident = $code:literal,)+ }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[repr(u32)]
        $vis enum $name { $($(#[$doc])* $variant = $code,)+ }

        impl $name {
            /// Every value, in the order of the codes.
            $vis const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// The code that stands for this in a record.
            #[must_use]
            $vis const fn code(self) -> u32 {
                self as u32
            }

            /// What a code stands for; `None` if this version does not know it.
            #[must_use]
            $vis const fn from_code(code: u32) -> Option<Self> {
                match code { $($code => Some(Self::$variant),)+ _ => None }
            }
        }

        impl $crate::record::code::Code for $name {
            fn known(code: u32) -> Option<Self> {
                Self::from_code(code)
            }
        }
    };
}

pub(crate) use coded;
