/* Compiled by itself under several standards and with every warning: the header needs no other before it. */
#include "striae.h"
