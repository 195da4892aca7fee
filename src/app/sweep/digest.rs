//! SHA-256 of what is written or read, without holding it.

use std::fmt::Write as _;
use std::io::{Read, Result, Write};

use sha2::{Digest, Sha256};

/// A writer that knows what went through it.
#[derive(Debug)]
pub(crate) struct Digested<W> {
    inner: W,
    hash: Sha256,
    bytes: u64,
}

impl<W: Write> Digested<W> {
    pub(crate) fn new(inner: W) -> Self {
        Self { inner, hash: Sha256::new(), bytes: 0 }
    }

    /// The writer, the number of bytes and their SHA-256 in hexadecimal digits.
    pub(crate) fn finish(self) -> (W, u64, String) {
        (self.inner, self.bytes, hexadecimal(self.hash))
    }
}

impl<W: Write> Write for Digested<W> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        let written = self.inner.write(bytes)?;
        self.hash.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> Result<()> {
        self.inner.flush()
    }
}

fn hexadecimal(hash: Sha256) -> String {
    hash.finalize().iter().fold(String::new(), |mut text, byte| {
        // writing to a string cannot fail
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// The number of bytes and their SHA-256 in hexadecimal digits.
///
/// # Errors
/// Those of the reader.
pub(crate) fn digest_of(mut from: impl Read) -> Result<(u64, String)> {
    let mut sink = Digested::new(std::io::sink());
    let mut room = vec![0; 1 << 16];
    loop {
        match from.read(&mut room)? {
            0 => break,
            n => sink.write_all(&room[..n])?,
        }
    }
    let (_, bytes, sha256) = sink.finish();
    Ok((bytes, sha256))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digest_is_that_of_the_whole() {
        let expected = crate::app::records::sha256(b"abcdef");
        assert_eq!(digest_of(&b"abcdef"[..]).unwrap(), (6, expected.clone()));
        let mut out = Digested::new(Vec::new());
        out.write_all(b"abc").unwrap();
        out.write_all(b"def").unwrap();
        assert_eq!(out.finish(), (b"abcdef".to_vec(), 6, expected));
    }
}
