#include <kedge/points/geometry.h>
