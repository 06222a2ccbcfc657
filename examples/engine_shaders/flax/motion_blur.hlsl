// Definitions that Flax's shader compiler makes before it reads the file.
#define FEATURE_LEVEL 4
// The program's triangle is flat, so that perspective changes nothing.
#define noperspective
#include "MotionBlur.shader"
