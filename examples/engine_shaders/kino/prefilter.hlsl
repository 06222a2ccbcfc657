// The programs of passes 0 to 4 of Reconstruction.shader.
#include "Prefilter.cginc"
