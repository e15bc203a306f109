// One function of each public header from C++: fails to link where extern "C" is missing.
#include "hdlyap/hdlyap.h"

int main()
{
    hd_scene_def def = hd_scene_def_default();
    def.number = 4;
    hd_trajectory *trajectory = nullptr;
    if (hd_trajectory_create(&trajectory, &def) != HD_OK) return 1;
    hd_trajectory_free(trajectory);
    hd_run_free(nullptr);
    if (hd_waves(&def, nullptr, 0) < 0 || !(HD_STEPS_THRESHOLD > 0)) return 1;
    return hd_status_text(HD_OK) == nullptr || hd_blas_query().threads < 0;
}
