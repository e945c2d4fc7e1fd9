/* Pictures for people: the library's, the relief's, and ten times their difference, side by side. */
#ifndef COMPARE_SHEETS_H
#define COMPARE_SHEETS_H
#include "film.h"

/* NULL if NAME.png (enlarged) and NAME.exr (scene-linear) were written to the folder, otherwise why not. */
const char *sheet_write(const Film *library, const Film *truth, double mean, const char *folder, const char *name);
#endif
