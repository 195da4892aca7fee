//! Exit codes.

use std::process::ExitCode;

/// The meaning of the exit code, in the order of the codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Exit {
    /// 0: yes, solved, done.
    Yes,
    /// 1: it ran and the answer is no (not equivalent, singular, infeasible).
    No,
    /// 2: bad usage or bad design.
    Refused,
    /// 3: not proved either way; roots may be missing.
    Inconclusive,
    /// 4: the program failed.
    Internal,
}

impl Exit {
    /// The number.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Yes => 0,
            Self::No => 1,
            Self::Refused => 2,
            Self::Inconclusive => 3,
            Self::Internal => 4,
        }
    }
}

/// The exit code of an answer that is yes, no or undecided.
impl From<Option<bool>> for Exit {
    fn from(answer: Option<bool>) -> Self {
        match answer {
            Some(true) => Self::Yes,
            Some(false) => Self::No,
            None => Self::Inconclusive,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
