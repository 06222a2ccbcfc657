//! The command `man`.

use clap_mangen::Man;
use store::printable_path;
use suite::Error;

use crate::arguments::{ManArgs, visible_command_line};
use crate::output::print::print;

/// Writes a page of the manual for the program and for each command.
pub fn execute(args: &ManArgs) -> Result<(), Error> {
    let mut program = visible_command_line().disable_help_subcommand(true);
    program.build();
    let pages = std::iter::once((&program, program.get_name().to_owned())).chain(
        (program.get_subcommands())
            .map(|command| (command, format!("shuttertruth-{}", command.get_name()))),
    );
    let mut count = 0;
    for (command, name) in pages {
        let man = Man::new(command.clone()).title(name.as_str()).section("1");
        let mut page = Vec::new();
        man.render(&mut page).expect("memory can be written");
        let path = args.out.join(format!("{name}.1"));
        frame::write_atomically(&path, &page)?;
        count += 1;
    }
    print(&format!(
        "written: {} ({count} pages)\n",
        printable_path(&args.out)
    ))
}
