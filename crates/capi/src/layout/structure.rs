//! A structure and its fields, and the macro that holds a list of them against a Rust type.

use glidepath_geometry::AXES;
use glidepath_link::{CodeWords, EventId, EventRecord, Latch, LongText, Quantiles, Text};

/// A structure of the library.
#[derive(Debug)]
pub(crate) struct Structure {
    /// Its name in C.
    pub(crate) name: &'static str,
    /// The record it is, with its version; empty if it is none.
    pub(crate) record: &'static str,
    #[cfg_attr(not(test), expect(dead_code, reason = "for the header and the manual"))]
    pub(crate) about: &'static str,
    pub(crate) size: usize,
    pub(crate) fields: &'static [Field],
}

/// A field of a structure.
#[derive(Debug)]
pub(crate) struct Field {
    pub(crate) name: &'static str,
    /// The type in C of one element.
    pub(crate) element: &'static str,
    /// Elements of an array, 0 for a single value.
    pub(crate) count: usize,
    pub(crate) offset: usize,
    pub(crate) size: usize,
    #[cfg_attr(not(test), expect(dead_code, reason = "for the header and the manual"))]
    pub(crate) about: &'static str,
}

impl Structure {
    /// Whether the fields cover every byte, in order.
    pub(crate) const fn is_gapless(&self) -> bool {
        let (mut index, mut end) = (0, 0);
        while index < self.fields.len() {
            let field = &self.fields[index];
            if field.offset != end {
                return false;
            }
            end += field.size;
            index += 1;
        }
        end == self.size
    }
}

/// What a Rust type is called in C.
pub(crate) trait InC {
    const ELEMENT: &'static str;
    const COUNT: usize = 0;
}

macro_rules! in_c {
    ($($rust:ty: $c:literal),+ $(,)?) => {
        $(impl InC for $rust { const ELEMENT: &'static str = $c; })+
    };
}
pub(super) use in_c;

in_c! {
    u32: "uint32_t",
    u64: "uint64_t",
    f64: "double",
    Quantiles: "gp_quantiles",
    EventId: "gp_event_id",
    EventRecord: "gp_event",
    CodeWords: "gp_code_words",
    Latch: "gp_latch",
}

impl<T: InC, const N: usize> InC for [T; N] {
    const ELEMENT: &'static str = T::ELEMENT;
    // An array of arrays is one of all their elements, in order.
    const COUNT: usize = if T::COUNT == 0 { N } else { N * T::COUNT };
}

impl InC for Text {
    const ELEMENT: &'static str = "char";
    const COUNT: usize = Self::CAPACITY;
}

impl InC for LongText {
    const ELEMENT: &'static str = "char";
    const COUNT: usize = Self::CAPACITY;
}

/// A value for every axis or joint.
pub(super) type Each<T> = [T; AXES];

macro_rules! structure {
    (
        $(#[doc = $about:literal])+
        $constant:ident: $name:literal = $type:ty, $record:expr, $size:literal {
            $($(#[doc = $field_about:literal])+ $field:ident: $field_type:ty,)+
        }
    ) => {
        $(#[doc = $about])+
        pub(super) const $constant: Structure = Structure {
            name: $name,
            record: $record,
            about: concat!($($about),+),
            size: $size,
            fields: &[$(Field {
                name: stringify!($field),
                element: <$field_type as InC>::ELEMENT,
                count: <$field_type as InC>::COUNT,
                offset: core::mem::offset_of!($type, $field),
                size: size_of::<$field_type>(),
                about: concat!($($field_about),+),
            }),+],
        };
        const _: () = {
            // A field of another type is an error here,
            $(const _: fn(&$type) -> &$field_type = |record| &record.$field;)+
            // and one that is missing, or elsewhere, here.
            assert!(size_of::<$type>() == $size, "a structure of libglidepath has another size");
            assert!($constant.is_gapless(), "a structure of libglidepath has other fields");
        };
    };
}
pub(super) use structure;
