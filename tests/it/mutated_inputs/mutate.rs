//! Files that are nearly right: edits of real ones, drawn from a seed.

/// Random numbers from a seed (splitmix64), so that a case is named by its number.
#[derive(Debug, Clone)]
pub(crate) struct Draw(u64);

impl Draw {
    /// The numbers of one case.
    pub(crate) fn of_case(seed: u64, case: u64) -> Self {
        Self(seed ^ case.wrapping_mul(0xd134_2543_de82_ef95))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Below `n`; 0 when `n` is.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.next() % u64::try_from(n.max(1)).unwrap_or(u64::MAX)).unwrap_or(0)
    }

    /// One of a list that is not empty.
    pub(crate) fn one<'a, T: ?Sized>(&mut self, of: &[&'a T]) -> &'a T {
        of[self.below(of.len())]
    }
}

/// Fragments that break readers of text: other encodings, unfinished brackets and strings, control characters, markup.
const FRAGMENTS: [&[u8]; 24] = [
    b"\0",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"\xe4\xb8\xad",
    b"\xe4\xb8",
    b"[",
    b"]",
    b"{",
    b"}",
    b"\"",
    b"'",
    b",",
    b"=",
    b"#",
    b"\n",
    b"\r",
    b"\\u0000",
    b"null",
    b"true",
    b"[]",
    b"{}",
    b"\"\"",
    b"../",
    b"<script>",
];

/// Fragments that break readers of numbers.
const NUMBERS: [&[u8]; 16] = [
    b"nan",
    b"inf",
    b"1e308",
    b"-1e308",
    b"1e999",
    b"1e-320",
    b"-0.0",
    b"0",
    b"18446744073709551616",
    b"-1",
    b"1e17",
    b"1000000",
    b"9007199254740993",
    b"0.1e-300",
    b"null",
    b"[1]",
];

/// One to four edits of `file`; the tail may be that of one of `others`.
pub(crate) fn mutated(draw: &mut Draw, file: &[u8], others: &[&[u8]]) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..=draw.below(4) {
        edit(draw, &mut bytes, others);
    }
    bytes
}

fn edit(draw: &mut Draw, bytes: &mut Vec<u8>, others: &[&[u8]]) {
    let at = draw.below(bytes.len() + 1);
    let reach = |n: usize| (at + n).min(bytes.len());
    match draw.below(9) {
        0 => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << draw.below(8);
            }
        }
        1 => {
            let end = reach(1 + draw.below(40));
            bytes.drain(at..end);
        }
        2 => {
            let part = bytes[at..reach(1 + draw.below(60))].repeat([1, 2, 50][draw.below(3)]);
            bytes.splice(at..at, part);
        }
        3 => {
            bytes.splice(at..at, draw.one(&FRAGMENTS).iter().copied());
        }
        4..=6 => {
            // the next number from here on
            let digit = |b: &u8| b.is_ascii_digit();
            let Some(start) = bytes[at..].iter().position(digit).map(|k| at + k) else { return };
            let of_number = |b: &u8| b.is_ascii_digit() || *b == b'.';
            let length = bytes[start..].iter().take_while(|b| of_number(b)).count();
            bytes.splice(start..start + length, draw.one(&NUMBERS).iter().copied());
        }
        7 => {
            let other = if others.is_empty() { &[][..] } else { draw.one(others) };
            let from = draw.below(other.len() + 1);
            bytes.truncate(at);
            bytes.extend_from_slice(&other[from..]);
        }
        // a file cut short, or nested deeper than a stack
        _ if draw.below(2) == 0 => bytes.truncate(at),
        _ => {
            let open: &[u8] = [&b"["[..], b"{\"a\":", b"[["][draw.below(3)];
            bytes.splice(at..at, open.repeat(20_000));
        }
    }
}
