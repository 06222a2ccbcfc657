//! Place to which control goes from another, in a function of naga.

use naga::SwitchValue;

use super::branches::Exit;

/// Where control goes from a place in a function of naga.
#[derive(Debug)]
pub(super) enum Next {
    /// To the block with this mark.
    Block(u32),
    Either(Box<Next>, Box<Next>),
    /// Out of a loop, or back to its begin.
    Repeat(Box<Next>, Box<Next>),
    Choice(Vec<(SwitchValue, Next)>),
    Return,
    Kill,
    /// To the end of the function.
    End,
    /// Into a loop without a block.
    Lost,
}

impl Next {
    /// Returns true if control goes where the exit of a block leads.
    pub fn is(&self, exit: &Exit) -> bool {
        match (exit, self) {
            (Exit::Unreachable, _) | (Exit::Return, Self::Return) | (Exit::Kill, Self::Kill) => {
                true
            }
            (Exit::To(block), next) => next.leads_to(*block),
            (Exit::Either { accept, reject }, next) if accept == reject => next.leads_to(*accept),
            (Exit::Either { accept, reject }, Self::Either(yes, no)) => {
                yes.leads_to(*accept) && no.leads_to(*reject)
            }
            (Exit::Either { accept, reject }, Self::Repeat(leave, again)) => {
                let is = |a, b| leave.leads_to(a) && again.leads_to(b);
                is(*accept, *reject) || is(*reject, *accept)
            }
            (Exit::Choice { cases, default }, Self::Choice(choices)) => {
                let goes = |value: SwitchValue, block: u32| {
                    let mut nexts = choices.iter().filter(|(known, _)| *known == value);
                    nexts.next().is_some_and(|(_, next)| next.leads_to(block))
                };
                choices.len() == cases.len() + 1
                    && goes(SwitchValue::Default, *default)
                    && (cases.iter()).all(|(value, block)| goes(SwitchValue::I32(*value), *block))
            }
            _ => false,
        }
    }

    fn leads_to(&self, block: u32) -> bool {
        matches!(self, Self::Block(next) if *next == block)
    }
}
