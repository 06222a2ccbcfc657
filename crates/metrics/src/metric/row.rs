//! Description of one metric, and the macro that makes groups of metrics from such rows.

use crate::{ErrorMap, Ideal};

/// Description of one metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The word used in bounds, tables and files; errors of colour add their region to it.
    pub name: &'static str,
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// Ideal value.
    pub ideal: Ideal,
    /// One-line description for a reader who is new to the metric.
    pub meaning: &'static str,
    /// Group in which a report shows it.
    pub group: Group,
    /// The map that it was pooled from, or else the one that best shows what it measures.
    pub map: ErrorMap,
    /// True for a percentile, which is not a smooth function of the truth: its intervals are wider.
    pub is_percentile: bool,
    /// Reason why no bound may name it; none for metrics that may be bounded.
    pub report_only: Option<&'static str>,
}

impl Row {
    /// Defaults that most rows share: not a percentile, and bounds may name them.
    pub(crate) const USUAL: Row = Row {
        name: "",
        unit: "",
        ideal: Ideal::Lowest,
        meaning: "",
        group: Group::RunJson,
        map: ErrorMap::Flip,
        is_percentile: false,
        report_only: None,
    };
}

/// Group of metrics that a reader looks at together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Errors of colour that people see.
    Seen,
    /// Error put into proportion: skill and equivalent sub-frames.
    Proportion,
    /// Labels: the objects that the shutter's time was given to.
    Label,
    /// The worst moving object's silhouette and mass.
    Silhouette,
    /// Errors split by what a single frame shows.
    Instant,
    /// Places that a filter gathers from.
    Gathered,
    /// Change from frame to frame, of sequences alone.
    Time,
    /// Scores in run.json that no page shows.
    RunJson,
}

impl Group {
    /// Groups that a page shows, in its order.
    pub const SHOWN: [Group; 6] = [
        Group::Seen,
        Group::Proportion,
        Group::Label,
        Group::Silhouette,
        Group::Instant,
        Group::Gathered,
    ];

    /// Returns the heading of the group.
    pub fn title(self) -> &'static str {
        match self {
            Group::Seen => "Visible errors",
            Group::Proportion => "Compared with no blur and with sub-frames",
            Group::Label => "Share given to the wrong object",
            Group::Silhouette => "Silhouette and mass of the worst mover",
            Group::Instant => "Without shadows, lights and reflections that move",
            Group::Gathered => "Where the filter gathers",
            Group::Time => "From frame to frame",
            Group::RunJson => "Only in run.json",
        }
    }
}

/// Declares metrics that are measured together: an enum, a struct with a score for each, and their
/// rows. A row that lacks a field is a compile error, and so is a score that is never measured.
macro_rules! metrics {
    (
        $(#[$of_metric:meta])*
        enum $Metric:ident;
        $(#[$of_scores:meta])*
        struct $Scores:ident of $Score:ident { $($(#[$of_fact:meta])* $fact:ident: $Fact:ty,)* }
        $($(#[$doc:meta])* $Variant:ident => $field:ident {
            name: $name:expr, unit: $unit:expr, ideal: $ideal:expr, group: $group:expr, map: $map:expr,
            meaning: $meaning:expr,
            $($more:ident: $value:expr,)?
        })*
    ) => {
        $(#[$of_metric])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $Metric {
            $($(#[$doc])* $Variant,)*
        }

        $(#[$of_scores])*
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        pub struct $Scores {
            $($(#[$of_fact])* pub $fact: $Fact,)*
            $($(#[$doc])* pub $field: $Score,)*
        }

        impl $Metric {
            /// All of them, in the order of a report.
            pub const ALL: [$Metric; [$($Metric::$Variant),*].len()] = [$($Metric::$Variant),*];

            /// Returns the row of the metric.
            pub fn row(self) -> Row {
                match self {
                    $($Metric::$Variant => Row {
                        name: $name,
                        unit: $unit,
                        ideal: $ideal,
                        group: $group,
                        map: $map,
                        meaning: $meaning,
                        $($more: $value,)?
                        ..Row::USUAL
                    },)*
                }
            }
        }

        impl $Scores {
            /// Makes scores that do not apply, because of `reason`; facts are defaults.
            pub fn not_applicable(reason: &str) -> Self {
                Self {
                    $($fact: Default::default(),)*
                    $($field: $Score::not_applicable(reason),)*
                }
            }

            /// Returns the score of a metric.
            pub fn get(&self, metric: $Metric) -> &$Score {
                match metric {
                    $($Metric::$Variant => &self.$field,)*
                }
            }

            /// Returns the score of a metric, to be replaced.
            pub fn get_mut(&mut self, metric: $Metric) -> &mut $Score {
                match metric {
                    $($Metric::$Variant => &mut self.$field,)*
                }
            }
        }
    };
}

pub(crate) use metrics;
