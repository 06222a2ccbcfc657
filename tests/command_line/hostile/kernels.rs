//! Filter folders that the device, the compiler or the numbers cannot take.
