//! Bits and numbers in an image of process data.

/// Whether a bit of an image is set.
pub(crate) fn bit(image: &[u8], bit: usize) -> bool {
    image
        .get(bit / 8)
        .is_some_and(|byte| byte >> (bit % 8) & 1 == 1)
}

/// Sets or clears a bit of an image.
pub(crate) fn put_bit(image: &mut [u8], bit: usize, is_on: bool) {
    if let Some(byte) = image.get_mut(bit / 8) {
        let mask = 1 << (bit % 8);
        *byte = if is_on { *byte | mask } else { *byte & !mask };
    }
}

/// A number of up to four bytes that begins with a byte.
pub(crate) fn number(image: &[u8], bit: usize, bits: u32) -> u32 {
    let bytes = image.iter().skip(bit / 8).take(bits as usize / 8);
    bytes.zip(0..).fold(0, |number, (byte, nth)| {
        number | u32::from(*byte) << (8 * nth)
    })
}

/// Writes such a number.
pub(crate) fn put_number(image: &mut [u8], bit: usize, bits: u32, number: u32) {
    let places = image.iter_mut().skip(bit / 8).take(bits as usize / 8);
    for (place, byte) in places.zip(number.to_le_bytes()) {
        *place = byte;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_and_numbers_are_where_they_were_put() {
        let mut image = [0xff, 0, 0, 0];
        put_bit(&mut image, 3, false);
        put_bit(&mut image, 8, true);
        put_bit(&mut image, 99, true);
        assert_eq!(image, [0xf7, 1, 0, 0]);
        assert!(bit(&image, 8) && !bit(&image, 3) && !bit(&image, 99));
        put_number(&mut image, 16, 16, 0xffff_8001);
        assert_eq!(image, [0xf7, 1, 1, 0x80]);
        assert_eq!(number(&image, 16, 16), 0x8001);
    }
}
