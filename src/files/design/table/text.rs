//! The bytes of a table as text: UTF-8, UTF-16, one byte a character, or a spreadsheet.

/// The text of a table and, if it is not UTF-8, its detected encoding.
pub(super) struct Decoded {
    pub(super) text: String,
    pub(super) guess: Option<String>,
}

/// Spreadsheet files are ZIP archives, which begin with these four bytes.
const ZIP: &[u8] = b"PK\x03\x04";

/// Whether the bytes are a spreadsheet, whose cells are no guess.
pub(super) fn is_workbook(bytes: &[u8]) -> bool {
    bytes.starts_with(ZIP)
}

/// The text of `bytes`, or the reason why there is none.
pub(super) fn decode(bytes: &[u8]) -> Result<Decoded, String> {
    if is_workbook(bytes) {
        #[cfg(feature = "workbook")]
        return super::workbook::decode(bytes);
        #[cfg(not(feature = "workbook"))]
        return Err("this is a packed spreadsheet file, not a text: save the sheet as CSV".into());
    }
    let wide = |bytes: &[u8], big_endian: bool| {
        if !bytes.len().is_multiple_of(2) {
            return Err("the text begins as UTF-16, but has an odd number of bytes".to_string());
        }
        let unit = |pair: &[u8]| {
            let pair = [pair[0], pair[1]];
            if big_endian { u16::from_be_bytes(pair) } else { u16::from_le_bytes(pair) }
        };
        let units: Vec<u16> = bytes.chunks_exact(2).map(unit).collect();
        let text = String::from_utf16(&units).map_err(|_| "the text is not valid UTF-16".to_string())?;
        Ok(Decoded { text, guess: Some("The text is read as UTF-16.".into()) })
    };
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => {
            let text = String::from_utf8(rest.to_vec());
            text.map(|text| Decoded { text, guess: None }).map_err(|_| {
                "the text has the mark of UTF-8 at its beginning, but is not valid UTF-8".to_string()
            })
        }
        [0xff, 0xfe, rest @ ..] => wide(rest, false),
        [0xfe, 0xff, rest @ ..] => wide(rest, true),
        // digits in UTF-16 have one byte that is zero
        [_, 0, ..] => wide(bytes, false),
        [0, _, ..] => wide(bytes, true),
        _ if bytes.contains(&0) => Err("this is not a text: it holds bytes that are zero".into()),
        _ => Ok(String::from_utf8(bytes.to_vec()).map_or_else(
            |_| Decoded {
                text: bytes.iter().map(|b| char::from(*b)).collect(),
                guess: Some(
                    "The text is not UTF-8 and is read with one byte a character (ISO 8859-1).".into(),
                ),
            },
            |text| Decoded { text, guess: None },
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_usual_encodings_of_a_text_give_the_text() {
        let text = "x;y;Höhe\n1,5;2;3\n";
        let utf16 = |order: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(order).collect::<Vec<u8>>();
        let marked = |mark: &[u8], bytes: Vec<u8>| [mark, &bytes].concat();
        let latin = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect::<Vec<u8>>();
        for bytes in [
            text.as_bytes().to_vec(),
            marked(&[0xef, 0xbb, 0xbf], text.as_bytes().to_vec()),
            marked(&[0xff, 0xfe], utf16(u16::to_le_bytes)),
            marked(&[0xfe, 0xff], utf16(u16::to_be_bytes)),
            utf16(u16::to_le_bytes),
            utf16(u16::to_be_bytes),
            latin,
        ] {
            assert_eq!(decode(&bytes).unwrap().text, text);
        }
        for bytes in [&b"PK\x03\x04rest"[..], &[0xff, 0xfe, 1], b"1,2\x003"] {
            assert!(decode(bytes).is_err());
        }
    }
}
