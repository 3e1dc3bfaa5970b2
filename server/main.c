/* SPDX-License-Identifier: MIT */
/* The program's entry; apart from the rest so that tests can link everything else. */
#include "server/cli/command.h"

int main(int argc, char **argv)
{
    return command_main(argc, argv);
}
