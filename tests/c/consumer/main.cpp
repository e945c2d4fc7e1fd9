#include <cstdio>
#include <memory>
#include <striae.h>

struct ReleaseTool {
    void operator()(const StriaeTool *tool) const { striae_tool_release(tool); }
};

int main() {
    StriaeTool *made = nullptr;
    if (striae_tool_sphero_cone(60.0, 0.2, 2.0, &made) != STRIAE_STATUS_OK) {
        std::printf("%s\n", striae_last_error());
        return 1;
    }
    const std::unique_ptr<const StriaeTool, ReleaseTool> tool(made);
    std::printf("striae from C++: %x\n", static_cast<unsigned>(striae_version()));
    return tool ? 0 : 1;
}
