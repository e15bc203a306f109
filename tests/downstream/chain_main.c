#include <hdlyap_ros/main.h>

int main(int argc, char **argv)
{
    static const hd_dynamics *const rows[] = {&of_chain};
    return hdlyap_node_main(argc, argv, rows, 1);
}
