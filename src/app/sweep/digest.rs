//! SHA-256 of data that is written or read, without keeping it in memory.

use std::io::{Read, Result, Write};

use data_encoding::HEXLOWER;
use sha2::{Digest, Sha256};

/// A writer that computes the digest of its data.
#[derive(Debug)]
pub struct Digested<W> {
    inner: W,
    hash: Sha256,
    bytes: u64,
}

impl<W: Write> Digested<W> {
    /// Computes the digest of data written to `inner`.
    pub fn new(inner: W) -> Self {
        Self { inner, hash: Sha256::new(), bytes: 0 }
    }

    /// The writer, the number of bytes and their SHA-256 in hexadecimal digits.
    pub fn finish(self) -> (W, u64, String) {
        (self.inner, self.bytes, HEXLOWER.encode(&self.hash.finalize()))
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

/// The number of bytes and their SHA-256 in hexadecimal digits.
///
/// # Errors
/// The errors of the reader.
pub fn digest_of(mut from: impl Read) -> Result<(u64, String)> {
    let mut sink = Digested::new(std::io::sink());
    std::io::copy(&mut from, &mut sink)?;
    let (_, bytes, sha256) = sink.finish();
    Ok((bytes, sha256))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digest_is_that_of_the_whole() {
        let expected = "bef57ec7f53a6d40beb640a780a639c83bc29ac8a9816f1fc6c5c6dcd93c4721".to_string();
        assert_eq!(records::sha256(b"abcdef"), expected);
        assert_eq!(digest_of(&b"abcdef"[..]).unwrap(), (6, expected.clone()));
        let mut out = Digested::new(Vec::new());
        out.write_all(b"abc").unwrap();
        out.write_all(b"def").unwrap();
        assert_eq!(out.finish(), (b"abcdef".to_vec(), 6, expected));
    }
}
