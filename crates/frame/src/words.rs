//! Words for the values of an enum, in names, in files and on the command line.

/// Gives an enum its values in order and their words; with `read`, text parses as a value.
macro_rules! words {
    ($Type:ident $(read as $what:literal)? { $($Value:ident => $word:literal,)+ }) => {
        impl $Type {
            /// Every value.
            pub const ALL: [$Type; [$($word),+].len()] = [$($Type::$Value),+];

            /// Returns the word used in names, in files and on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $($Type::$Value => $word,)+
                }
            }
        }

        impl std::fmt::Display for $Type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        $(impl std::str::FromStr for $Type {
            type Err = String;

            fn from_str(text: &str) -> Result<Self, String> {
                let value = Self::ALL.into_iter().find(|value| value.name() == text);
                value.ok_or_else(|| {
                    let words = Self::ALL.map(Self::name).join(", ");
                    format!("{} \"{text}\" is unknown; allowed: {words}", $what)
                })
            }
        })?
    };
}

pub(crate) use words;
