#include <stdio.h>
#include <striae.h>

int main(void) {
    StriaeTool *tool = NULL;
    if (striae_tool_preset(STRIAE_TOOL_PRESET_VICKERS, &tool) != STRIAE_STATUS_OK) {
        printf("%s\n", striae_last_error());
        return 1;
    }
    striae_tool_release(tool);
    printf("striae %u.%u.%u\n", (unsigned)(striae_version() >> 16), (unsigned)(striae_version() >> 8 & 255u),
           (unsigned)(striae_version() & 255u));
    return 0;
}
