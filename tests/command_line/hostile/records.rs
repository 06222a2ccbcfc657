//! Files of this program, damaged or made up.
