//! Arguments of `catalogue`.

use clap::Args;

use super::adapter::AdapterArgs;
use super::measure::MeasureArgs;

/// `shuttertruth catalogue`
#[derive(Debug, Args)]
pub struct CatalogueArgs {
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}
