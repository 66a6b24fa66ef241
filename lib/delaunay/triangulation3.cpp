#include "delaunay/triangulation3.h"
