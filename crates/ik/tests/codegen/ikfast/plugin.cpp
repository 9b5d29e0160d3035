// Includes a printed solver like MoveIt's plugin template, within a namespace after its headers, and calls it like the plugin.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include <float.h>
// MoveIt's headers include this one through those of Eigen.
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace robot_group {
#define IKFAST_NO_MAIN
#include "5_ikfast.cpp"

// Reads lines of eetrans (3), eerot (9) and the free value. For each it prints the number of solutions, then for each solution its branch, its joints,
// and their forward kinematics.
static int serve()
{
    double line[13];
    const std::size_t joints = static_cast<std::size_t>(GetNumJoints());
    if (GetIkRealSize() != static_cast<int>(sizeof(IkReal)) || GetNumFreeParameters() > 1) {
        return 1;
    }
    std::printf("%d %d\n", GetIkType(), GetNumFreeParameters() > 0 ? *GetFreeParameters() : -1);
    for (;;) {
        for (double &number : line) {
            if (std::scanf("%lf", &number) != 1) {
                return 0;
            }
        }
        IkReal eetrans[3], eerot[9], free;
        std::copy(line, line + 3, eetrans);
        std::copy(line + 3, line + 12, eerot);
        free = static_cast<IkReal>(line[12]);
        IkSolutionList<IkReal> solutions;
        const bool success = ComputeIk(eetrans, eerot, GetNumFreeParameters() > 0 ? &free : nullptr, solutions);
        if (success != (solutions.GetNumSolutions() > 0)) {
            return 1;
        }
        std::printf("%u\n", static_cast<unsigned>(solutions.GetNumSolutions()));
        for (std::size_t i = 0; i < solutions.GetNumSolutions(); i++) {
            std::vector<IkReal> q(joints);
            if (!solutions.GetSolution(i).GetFree().empty()) {
                return 1;
            }
            solutions.GetSolution(i).GetSolution(&q[0], nullptr);
            std::printf("%llu", solutions.GetSolution(i).Branch());
            for (IkReal value : q) {
                std::printf(" %.17g", static_cast<double>(value));
            }
            IkReal position[3] = {0, 0, 0}, rotation[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
            ComputeFk(&q[0], position, rotation);
            for (IkReal value : position) {
                std::printf(" %.17g", static_cast<double>(value));
            }
            for (IkReal value : rotation) {
                std::printf(" %.17g", static_cast<double>(value));
            }
            std::printf("\n");
        }
    }
}
} // namespace robot_group

int main()
{
    return robot_group::serve();
}
