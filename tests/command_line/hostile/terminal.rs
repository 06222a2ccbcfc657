//! What reaches the terminal, the log and the exit code.
