//! The moves requested on the command line.

use crate::app::cli::failure::Failure;
use ::files::design::{InvalidShare, Share};
use platform::manipulator::LegIndex;

const FORM: &str = "a move is LEG:FAMILY:T[,U,..], for instance 1:3:0.25 or 1:P1:P4-P5:1/4";

/// A family as named by the user.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum NamedFamily {
    /// Its number in `equipod equivalents components`, from 1.
    Number(usize),
    /// The joints that span its flats, not yet looked up: `P1:P4-P5`.
    Between(String),
}

/// One move.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MoveRequest {
    pub(super) leg: LegIndex,
    pub(super) along: NamedFamily,
    pub(super) parameters: Vec<Share>,
}

/// All requested moves, in order.
pub(super) fn requests(
    leg: Option<&str>,
    along: Option<&str>,
    to: Option<&str>,
    moves: &[String],
) -> Result<Vec<MoveRequest>, Failure> {
    let mut out = Vec::new();
    if let (Some(leg), Some(along), Some(to)) = (leg, along, to) {
        out.push(request(leg, along, to)?);
    }
    for text in moves {
        let Some((leg, (along, to))) =
            text.split_once(':').and_then(|(leg, rest)| Some((leg, rest.rsplit_once(':')?)))
        else {
            return Err(Failure::refused("move::bad_move", format!("`{text}` is not a move")).with_help(FORM));
        };
        out.push(request(leg, along, to)?);
    }
    Ok(out)
}

fn request(leg: &str, along: &str, to: &str) -> Result<MoveRequest, Failure> {
    let bad = |message: String| Failure::refused("move::bad_move", message).with_help(FORM);
    let parameter = |text: &str| text.parse().map_err(|why: InvalidShare| bad(why.to_string()));
    let parameters: Result<Vec<Share>, Failure> = to.split(',').map(parameter).collect();
    let along = along.trim();
    let along = along.parse().map_or_else(|_| NamedFamily::Between(along.to_string()), NamedFamily::Number);
    Ok(MoveRequest { leg: self::leg(leg)?, along, parameters: parameters? })
}

/// A leg by its number from 1.
pub(super) fn leg(text: &str) -> Result<LegIndex, Failure> {
    let number = text.trim().parse::<usize>().ok().and_then(|n| n.checked_sub(1));
    number.and_then(LegIndex::new).ok_or_else(|| {
        let message = format!("`{text}` is not a leg: they are numbered 1 to 6");
        Failure::refused("move::no_such_leg", message)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moves_in_one_word_and_in_three() {
        let list = requests(None, None, None, &["1:3:0.25".into(), "6:P1:P4-P5:-1/2,2".into()]).unwrap();
        let numbers = |k: usize| list[k].parameters.iter().map(Share::nearest).collect::<Vec<_>>();
        assert_eq!((list[0].along.clone(), numbers(0)), (NamedFamily::Number(3), vec![0.25]));
        assert_eq!((list[1].leg.get(), list[1].along.clone()), (5, NamedFamily::Between("P1:P4-P5".into())));
        assert_eq!(numbers(1), [-0.5, 2.0]);
        assert_eq!(requests(Some("1"), Some("3"), Some("0.25"), &[]).unwrap()[0], list[0]);
        for bad in ["1:0.25", "x:1:0.2", "7:1:0.2", "0:1:0.2", "1:2:", "1:2:nan", "1"] {
            assert!(requests(None, None, None, &[bad.to_string()]).is_err(), "{bad}");
        }
    }
}
