//! The questions of `equipod new` on a terminal.

use std::io::{BufRead, Write};

use crate::app::cli::files::OutputPath;
use ::files::design::{HexapodSizes, ServoHome, ServoSizes};

/// The answers of the user.
#[derive(Debug, PartialEq)]
pub(super) struct PromptedHexapod {
    pub(super) sizes: PromptedSizes,
    pub(super) units: String,
    pub(super) output: OutputPath,
}

#[derive(Debug, PartialEq)]
pub(super) enum PromptedSizes {
    Legs(HexapodSizes),
    Servos(ServoSizes),
}

/// Asks for sizes until they make a hexapod; `None`: the input ended.
pub(super) fn ask(input: &mut impl BufRead, output: &mut impl Write) -> Option<PromptedHexapod> {
    let mut session = Questions { input, output };
    session.say("A hexapod with threefold symmetry; an empty answer takes the value in brackets.")?;
    let units = session.text("Unit of length", "mm")?;
    let sizes = loop {
        let crank = session.number("Length of the servo cranks, or 0 for legs of variable length", "0")?;
        let centres = if crank == 0.0 { "base joints" } else { "crank centres" };
        let sizes = HexapodSizes {
            radius: [
                session.number(&format!("Radius of the circle of the {centres}"), "500")?,
                session.number("Radius of the circle of the platform joints", "300")?,
            ],
            spread_deg: [
                session.number(&format!("Angle between the two {centres} of a pair, in degrees"), "20")?,
                session.number("Angle between the two joints of a pair on the platform, in degrees", "20")?,
            ],
            height: session.number("Height of the platform above the base at home", "400")?,
        };
        let checked = if crank == 0.0 {
            sizes.check().map(|()| PromptedSizes::Legs(sizes)).map_err(|why| why.to_string())
        } else {
            let HexapodSizes { radius, spread_deg, height } = sizes;
            let home = ServoHome::LevelAt { height };
            let sizes = ServoSizes { radius, spread_deg, crank, angle_deg: None, home };
            sizes.solved().map(|_| PromptedSizes::Servos(sizes)).map_err(|why| why.to_string())
        };
        match checked {
            Ok(sizes) => break sizes,
            Err(why) => session.say(&format!("That is no hexapod: {why}."))?,
        }
    };
    let output = session.text("File to write", "hexapod.toml")?;
    Some(PromptedHexapod { sizes, units, output: std::ffi::OsString::from(output).into() })
}

struct Questions<'a, I, O> {
    input: &'a mut I,
    output: &'a mut O,
}

impl<I: BufRead, O: Write> Questions<'_, I, O> {
    fn say(&mut self, line: &str) -> Option<()> {
        writeln!(self.output, "{line}").ok()
    }

    fn text(&mut self, question: &str, default: &str) -> Option<String> {
        write!(self.output, "{question} [{default}]: ").ok()?;
        self.output.flush().ok()?;
        let mut answer = String::new();
        // at the end of the input nothing is read, not even a line end
        let read = self.input.read_line(&mut answer).ok()?;
        let answer = answer.trim();
        match (read, answer) {
            (0, _) => None,
            (_, "") => Some(default.into()),
            _ => Some(answer.into()),
        }
    }

    fn number(&mut self, question: &str, default: &str) -> Option<f64> {
        loop {
            let answer = self.text(question, default)?;
            match answer.replace(',', ".").parse() {
                Ok(x) => return Some(x),
                Err(_) => self.say(&format!("`{}` is not a number.", answer.escape_debug()))?,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answered(answers: &str) -> (Option<PromptedHexapod>, String) {
        let mut output = Vec::new();
        let asked = ask(&mut answers.as_bytes(), &mut output);
        (asked, String::from_utf8(output).unwrap())
    }

    #[test]
    fn empty_answers_take_the_defaults_and_slips_are_asked_again() {
        let (asked, _) = answered("\n\n\n\n\n\n\n\n");
        let meant = HexapodSizes { radius: [500.0, 300.0], spread_deg: [20.0, 20.0], height: 400.0 };
        assert_eq!(
            asked.unwrap(),
            PromptedHexapod {
                sizes: PromptedSizes::Legs(meant),
                units: "mm".into(),
                output: std::ffi::OsString::from("hexapod.toml").into()
            }
        );
        let (asked, said) = answered("in\n\nten\n10\n6,5\n130\n20\n8\n\n10\n6.5\n30\n20\n8\nmine.toml\n");
        assert_eq!(
            asked.unwrap().sizes,
            PromptedSizes::Legs(HexapodSizes { radius: [10.0, 6.5], spread_deg: [30.0, 20.0], height: 8.0 })
        );
        assert!(said.contains("`ten` is not a number.") && said.contains("That is no hexapod"), "{said}");
        assert_eq!(answered("mm\n0\n500\n").0, None);
    }

    #[test]
    fn the_length_of_a_crank_gives_a_rotary_hexapod() {
        let (asked, said) = answered("\n24\n80\n60\n0\n20\n110\n24\n80\n60\n20\n20\n110\n\n");
        let meant = ServoSizes {
            radius: [80.0, 60.0],
            spread_deg: [20.0, 20.0],
            crank: 24.0,
            angle_deg: None,
            home: ServoHome::LevelAt { height: 110.0 },
        };
        assert_eq!(asked.unwrap().sizes, PromptedSizes::Servos(meant));
        assert!(said.contains("two cranks cannot have one centre"), "{said}");
    }
}
