//! The tables of fields: which field of a record has which number and type. Writing, reading and
//! the description in the file are all made from them.

use crate::protobuf::{Fields, Malformed, Wire, put_bytes, put_fixed64, put_varint};
use glidepath_link::{CodeWords, EventRecord, Quantiles, Text};

/// Types of a `FieldDescriptorProto`.
const DOUBLE: u64 = 1;
const FIXED64: u64 = 6;
const STRING: u64 = 9;
const MESSAGE: u64 = 11;
const UINT32: u64 = 13;
/// Its labels.
const OPTIONAL: u64 = 1;
const REPEATED: u64 = 3;

/// A field of a record.
pub(crate) trait Value {
    /// Type and label in the description.
    const TYPE: (u64, u64);
    /// The message that it is, where it is one.
    const MESSAGE: Option<Nested> = None;
    fn put(&self, number: u32, out: &mut Vec<u8>);
    fn get(&mut self, wire: Wire<'_>) -> Result<(), Malformed>;
}

/// A message within messages.
#[derive(Clone, Copy)]
pub(crate) struct Nested {
    /// Its full name.
    pub(crate) name: &'static str,
    pub(crate) fields: fn() -> Vec<FieldOf>,
}

impl Nested {
    const fn of<M: Message>() -> Self {
        Self {
            name: M::NAME,
            fields: M::fields,
        }
    }
}

/// Eight bytes each, alone or in a row.
macro_rules! eight_bytes {
    ($value:ty, $kind:ident) => {
        impl Value for $value {
            const TYPE: (u64, u64) = ($kind, OPTIONAL);

            fn put(&self, number: u32, out: &mut Vec<u8>) {
                put_fixed64(number, self.to_le_bytes(), out);
            }

            fn get(&mut self, wire: Wire<'_>) -> Result<(), Malformed> {
                let Wire::Fixed64(bytes) = wire else {
                    return Err(Malformed);
                };
                *self = Self::from_le_bytes(bytes);
                Ok(())
            }
        }

        impl<const N: usize> Value for [$value; N] {
            const TYPE: (u64, u64) = ($kind, REPEATED);

            fn put(&self, number: u32, out: &mut Vec<u8>) {
                put_packed(number, self.iter().map(|value| value.to_le_bytes()), out);
            }

            fn get(&mut self, wire: Wire<'_>) -> Result<(), Malformed> {
                for (value, bytes) in self.iter_mut().zip(get_packed(wire, N)?) {
                    *value = <$value>::from_le_bytes(bytes);
                }
                Ok(())
            }
        }
    };
}
eight_bytes!(u64, FIXED64);
eight_bytes!(f64, DOUBLE);

impl Value for u32 {
    const TYPE: (u64, u64) = (UINT32, OPTIONAL);

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        put_varint(number, (*self).into(), out);
    }

    fn get(&mut self, wire: Wire<'_>) -> Result<(), Malformed> {
        let Wire::Varint(value) = wire else {
            return Err(Malformed);
        };
        *self = value.try_into().map_err(|_| Malformed)?;
        Ok(())
    }
}

impl Value for Text {
    const TYPE: (u64, u64) = (STRING, OPTIONAL);

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        put_bytes(number, self.as_str().as_bytes(), out);
    }

    fn get(&mut self, wire: Wire<'_>) -> Result<(), Malformed> {
        let Wire::Bytes(bytes) = wire else {
            return Err(Malformed);
        };
        *self = Self::new(str::from_utf8(bytes).map_err(|_| Malformed)?);
        Ok(())
    }
}

/// Numbers in a row, packed.
fn put_packed(number: u32, values: impl Iterator<Item = [u8; 8]>, out: &mut Vec<u8>) {
    let bytes: Vec<u8> = values.flatten().collect();
    put_bytes(number, &bytes, out);
}

fn get_packed<'a>(
    wire: Wire<'a>,
    count: usize,
) -> Result<impl Iterator<Item = [u8; 8]> + 'a, Malformed> {
    let Wire::Bytes(bytes) = wire else {
        return Err(Malformed);
    };
    let (chunks, rest) = bytes.as_chunks::<8>();
    if chunks.len() != count || !rest.is_empty() {
        return Err(Malformed);
    }
    Ok(chunks.iter().copied())
}

/// Half, 99 %, 99.9 %, the longest.
impl Value for Quantiles {
    const TYPE: (u64, u64) = <[u64; 4]>::TYPE;

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        [self.p50_ns, self.p99_ns, self.p999_ns, self.max_ns].put(number, out);
    }

    fn get(&mut self, wire: Wire<'_>) -> Result<(), Malformed> {
        let mut values = [0; 4];
        values.get(wire)?;
        [self.p50_ns, self.p99_ns, self.p999_ns, self.max_ns] = values;
        Ok(())
    }
}

/// P, Q, which of them are given, and what is reserved: a double has room for all of them.
impl Value for CodeWords {
    const TYPE: (u64, u64) = <[f64; 4]>::TYPE;

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        let (given, reserved) = (self.given.into(), self.reserved.into());
        [self.p, self.q, given, reserved].put(number, out);
    }

    fn get(&mut self, wire: Wire<'_>) -> Result<(), Malformed> {
        let mut values = [0.0; 4];
        values.get(wire)?;
        let [p, q, given, reserved] = values;
        (self.p, self.q) = (p, q);
        (self.given, self.reserved) = (whole(given)?, whole(reserved)?);
        Ok(())
    }
}

/// Each a message of its own; those that are not used, which have no kind, are left out.
impl<const N: usize> Value for [EventRecord; N] {
    const TYPE: (u64, u64) = (MESSAGE, REPEATED);
    const MESSAGE: Option<Nested> = Some(Nested::of::<EventRecord>());

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        for event in self.iter().filter(|event| event.kind != 0) {
            let mut bytes = Vec::new();
            Message::put(event, &mut bytes);
            put_bytes(number, &bytes, out);
        }
    }

    fn get(&mut self, wire: Wire<'_>) -> Result<(), Malformed> {
        let Wire::Bytes(bytes) = wire else {
            return Err(Malformed);
        };
        let free = self.iter_mut().find(|event| event.kind == 0);
        free.ok_or(Malformed)?.read(bytes)
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::float_cmp,
    reason = "a number that is changed by it is refused"
)]
fn whole(value: f64) -> Result<u32, Malformed> {
    let whole = value as u32;
    (f64::from(whole) == value)
        .then_some(whole)
        .ok_or(Malformed)
}

/// A field in the description.
pub(crate) struct FieldOf {
    pub(crate) name: &'static str,
    pub(crate) number: u32,
    pub(crate) kind: (u64, u64),
    pub(crate) message: Option<Nested>,
    /// Bytes in the record.
    #[cfg(test)]
    pub(crate) size: usize,
}

impl FieldOf {
    /// Its type, as Protocol Buffers write it.
    pub(crate) fn type_name(&self) -> String {
        if let Some(message) = self.message {
            let (_, name) = parted(message.name);
            return format!("repeated {name}");
        }
        let name = match self.kind {
            (DOUBLE, REPEATED) => "repeated double",
            (DOUBLE, _) => "double",
            (FIXED64, REPEATED) => "repeated fixed64",
            (FIXED64, _) => "fixed64",
            (STRING, _) => "string",
            _ => "uint32",
        };
        name.to_owned()
    }
}

/// Package and name of a message.
pub(crate) fn parted(name: &'static str) -> (&'static str, &'static str) {
    name.rsplit_once('.').unwrap_or(("", name))
}

/// A `DescriptorProto`.
fn described_message(name: &'static str, fields: &[FieldOf]) -> Vec<u8> {
    let mut message = Vec::new();
    put_bytes(1, parted(name).1.as_bytes(), &mut message);
    for field in fields {
        let mut described = Vec::new();
        put_bytes(1, field.name.as_bytes(), &mut described);
        put_varint(3, field.number.into(), &mut described);
        put_varint(4, field.kind.1, &mut described);
        put_varint(5, field.kind.0, &mut described);
        if let Some(message) = field.message {
            put_bytes(6, format!(".{}", message.name).as_bytes(), &mut described);
        }
        put_bytes(2, &described, &mut message);
    }
    message
}

/// A record that is a message.
pub(crate) trait Message: Sized {
    /// Its full name.
    const NAME: &'static str;
    fn fields() -> Vec<FieldOf>;
    fn put(&self, out: &mut Vec<u8>);
    fn get(&mut self, number: u32, wire: Wire<'_>) -> Result<(), Malformed>;

    /// Reads a message. Fields that it does not have stay as they are; those that nobody knows are
    /// skipped.
    fn read(&mut self, bytes: &[u8]) -> Result<(), Malformed> {
        let mut fields = Fields(bytes);
        while let Some((number, wire)) = fields.next()? {
            self.get(number, wire)?;
        }
        Ok(())
    }

    /// A `FileDescriptorSet` with this message in it, and those within it.
    fn description() -> Vec<u8> {
        let mut file = Vec::new();
        put_bytes(1, format!("{}.proto", Self::NAME).as_bytes(), &mut file);
        put_bytes(2, parted(Self::NAME).0.as_bytes(), &mut file);
        let fields = Self::fields();
        for nested in fields.iter().filter_map(|field| field.message) {
            let message = described_message(nested.name, &(nested.fields)());
            put_bytes(4, &message, &mut file);
        }
        put_bytes(4, &described_message(Self::NAME, &fields), &mut file);
        // In this syntax numbers in a row are packed.
        put_bytes(12, b"proto3", &mut file);
        let mut set = Vec::new();
        put_bytes(1, &file, &mut set);
        set
    }
}

fn kind_of<V: Value>(_: &V) -> (u64, u64) {
    V::TYPE
}

/// Describes a field of a record by an example of it.
pub(crate) fn described<V: Value>(name: &'static str, number: u32, value: &V) -> FieldOf {
    let kind = kind_of(value);
    FieldOf {
        name,
        number,
        kind,
        message: V::MESSAGE,
        #[cfg(test)]
        size: size_of::<V>(),
    }
}

/// A record as a message: the numbers of its fields, which are never given twice.
macro_rules! message {
    ($record:ty, $name:literal, { $($number:literal $field:ident,)* }) => {
        impl $crate::table::Message for $record {
            const NAME: &'static str = $name;

            fn fields() -> Vec<$crate::table::FieldOf> {
                let example: Self = bytemuck::Zeroable::zeroed();
                vec![$($crate::table::described(stringify!($field), $number, &example.$field),)*]
            }

            fn put(&self, out: &mut Vec<u8>) {
                $($crate::table::Value::put(&self.$field, $number, out);)*
            }

            fn get(
                &mut self,
                number: u32,
                wire: $crate::protobuf::Wire<'_>,
            ) -> Result<(), $crate::protobuf::Malformed> {
                match number {
                    $($number => $crate::table::Value::get(&mut self.$field, wire),)*
                    _ => Ok(()),
                }
            }
        }
    };
}
pub(crate) use message;
