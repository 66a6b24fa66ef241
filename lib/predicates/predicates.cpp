#include "predicates/predicates.h"
