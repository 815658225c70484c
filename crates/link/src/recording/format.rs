//! The header of a recording.

use crate::Record;

pub(super) const MAGIC: [u8; 8] = *b"GLIDEREC";
pub(super) const VERSION: u32 = 1;
pub(super) const NAME_BYTES: usize = 48;

#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct Header {
    pub(super) magic: [u8; 8],
    pub(super) version: u32,
    pub(super) record_size: u32,
    pub(super) name: [u8; NAME_BYTES],
}

impl Header {
    pub(super) fn of<R: Record>() -> Self {
        let mut name = [0; NAME_BYTES];
        for (to, from) in name.iter_mut().zip(R::NAME.as_bytes()) {
            *to = *from;
        }
        let record_size = u32::try_from(size_of::<R>()).unwrap_or(u32::MAX);
        Self {
            magic: MAGIC,
            version: VERSION,
            record_size,
            name,
        }
    }

    pub(super) fn name(&self) -> String {
        let used = self
            .name
            .split(|byte| *byte == 0)
            .next()
            .unwrap_or_default();
        String::from_utf8_lossy(used).into_owned()
    }
}
