//! Doubts about a filter that is allowed.

use super::Filter;
use super::pass::Pass;
use crate::shader::EntryPoint;

impl Filter {
    /// Lists what its author may have overlooked, a sentence each.
    pub fn list_notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        for (pass, line) in self.passes.iter().zip(&self.lines.passes) {
            let entry = self.entry_point(pass);
            let place = format!(
                "{}:{line}: pass \"{}\"",
                self.lines.path.display(),
                pass.entry
            );
            if let Some(texture) = self.find_smaller(pass, entry) {
                notes.push(format!(
                    "{place} has no `over`: it runs over all pixels of the picture, and \"{texture}\", which it writes, has fewer texels; \
                     add over = \"{texture}\""
                ));
            }
            if let Some(function) = &entry.divergent_barrier {
                notes.push(format!(
                    "{place}: only some invocations of a workgroup may reach a barrier in \"{function}\", as after an early `return`; \
                     what happens then depends on the driver; take the barrier out of branches and loops that differ among invocations"
                ));
            }
        }
        notes
    }

    /// Finds the first texture that a kernel writes if all of them are smaller than the picture
    /// over which it runs.
    fn find_smaller<'f>(&'f self, pass: &Pass, entry: &'f EntryPoint) -> Option<&'f str> {
        let is_smaller = |name: &String| {
            let texture = self.texture(name);
            texture.is_some_and(|texture| texture.divided_by.is_some())
        };
        let all =
            pass.over.is_none() && !entry.is_fragment() && entry.writes.iter().all(is_smaller);
        entry.writes.first().map(|name| &name[..]).filter(|_| all)
    }
}
