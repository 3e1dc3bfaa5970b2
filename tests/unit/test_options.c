/* SPDX-License-Identifier: MIT */
/* The table of options and what is read by it: precedence, checks, messages. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "protocol/nodes.h"
#include "protocol/picture.h"
#include "server/cli/command.h"
#include "server/cli/options.h"

static char *const no_arguments[] = {NULL};
static struct options options;
static struct error err;

static bool read_as(const char *command, char *const *arguments)
{
    static char *argv[32];
    int argc = 0;

    while (arguments[argc]) {
        argv[argc] = arguments[argc];
        argc++;
    }
    argv[argc] = NULL;
    options_finish(&options);
    err = (struct error){0};
    return options_read(&options, command_find(command), argc, argv, &err);
}

#define READ(command, ...) read_as(command, (char *[]){__VA_ARGS__, NULL})
#define ASSERT_REFUSED(wanted_place, wanted_message)                                               \
    do {                                                                                           \
        assert_string_equal(err.place, wanted_place);                                              \
        assert_string_equal(err.message, wanted_message);                                          \
    } while (0)

static char config_path[] = "/tmp/fieldcast-options-XXXXXX";

static void write_config(const char *text)
{
    FILE *file = fopen(config_path, "w");

    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static int set_up(void **state)
{
    (void)state;
    unsetenv("FIELDCAST_PORT");
    unsetenv("FIELDCAST_CONFIG");
    setenv("HOME", "/home/somebody", 1);
    unsetenv("XDG_DATA_HOME");
    unsetenv("XDG_CONFIG_HOME");
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    options_finish(&options);
    return 0;
}

static void table_is_consistent(void **state)
{
    (void)state;
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = option_row((enum option)i);
        assert_non_null(row->name);
        assert_non_null(row->doc);
        assert_true(row->commands != 0);
        assert_int_equal(row->type == OPTION_FLAG, row->value == NULL);
        assert_int_equal(row->type == OPTION_CHOICE || row->type == OPTION_CHOICES,
                         row->choice != NULL);
        for (int j = 0; j < i; j++) {
            assert_string_not_equal(row->name, option_row((enum option)j)->name);
        }
    }
}

static void every_command_reads_its_defaults(void **state)
{
    (void)state;
    for (int i = 0; i < COMMAND_COUNT; i++) {
        const struct command *command = command_at((enum command_id)i);
        assert_ptr_equal(command_find(command->name), command);
        char *operands[] = {"x", "y", "z", NULL};
        operands[command->exactly ? command->exactly : 1] = NULL;
        if (!read_as(command->name, command->operands ? operands : no_arguments)) {
            fail_msg("%s: %s: %s", command->name, err.place, err.message);
        }
    }
}

static void defaults_stand_in_the_home_directory(void **state)
{
    (void)state;
    assert_true(read_as("serve", no_arguments));
    assert_string_equal(option_text(&options, OPTION_DATA),
                        "/home/somebody/.local/share/fieldcast");
    setenv("XDG_DATA_HOME", "/data", 1);
    assert_true(read_as("serve", no_arguments));
    assert_string_equal(option_text(&options, OPTION_DATA), "/data/fieldcast");
    assert_true(READ("serve", "--data", "~/scenes"));
    assert_string_equal(option_text(&options, OPTION_DATA), "/home/somebody/scenes");
    assert_null(option_text(&options, OPTION_TOKEN_FILE));
}

static void the_nearest_source_wins(void **state)
{
    (void)state;
    assert_true(read_as("serve", no_arguments));
    assert_int_equal(option_int(&options, OPTION_PORT), 8080);
    write_config("# ours\n\n port = 1001 \nlog-level=debug\n");
    assert_true(READ("serve", "--config", config_path));
    assert_int_equal(option_int(&options, OPTION_PORT), 1001);
    assert_string_equal(option_text(&options, OPTION_LOG_LEVEL), "debug");
    setenv("FIELDCAST_PORT", "1002", 1);
    assert_true(READ("serve", "--config", config_path));
    assert_int_equal(option_int(&options, OPTION_PORT), 1002);
    assert_true(READ("serve", "--port=1003", "--config", config_path));
    assert_int_equal(option_int(&options, OPTION_PORT), 1003);
    assert_int_equal(options.values[OPTION_PORT].source, SOURCE_ARGUMENT);
    assert_int_equal(options.values[OPTION_LOG_LEVEL].source, SOURCE_FILE);
}

static void the_environment_names_the_config_file(void **state)
{
    (void)state;
    write_config("port = 1001\n");
    setenv("FIELDCAST_CONFIG", config_path, 1);
    assert_true(read_as("serve", no_arguments));
    assert_int_equal(option_int(&options, OPTION_PORT), 1001);
}

static void values_are_checked(void **state)
{
    (void)state;
    assert_false(READ("serve", "--port", "70000"));
    ASSERT_REFUSED("--port", "70000 is above the maximum 65535");
    assert_false(READ("serve", "--port=-1"));
    ASSERT_REFUSED("--port", "-1 is below the minimum 0");
    assert_false(READ("serve", "--port", "80x"));
    ASSERT_REFUSED("--port", "'80x' is not a number");
    assert_false(READ("serve", "--port", "80.5"));
    ASSERT_REFUSED("--port", "80.5 is not a whole number");
    assert_false(READ("serve", "--port", "nan"));
    ASSERT_REFUSED("--port", "'nan' is not a number");
    assert_false(READ("serve", "--port", ""));
    ASSERT_REFUSED("--port", "'' is not a number");
    assert_false(READ("serve", "--data", ""));
    ASSERT_REFUSED("--data", "is empty");
    assert_false(READ("serve", "--device", "cpu"));
    ASSERT_REFUSED("--device", "'cpu' is none of auto, gpu, software, none");
    assert_false(READ("render", "--camera-position", "1,2", "a.json"));
    ASSERT_REFUSED("--camera-position", "needs three numbers, as 0,1.5,6");
    assert_false(READ("render", "--camera-position", "1,2,3,4", "a.json"));
    ASSERT_REFUSED("--camera-position", "needs three numbers, as 0,1.5,6");
    assert_false(READ("render", "--region", "1,2,3", "a.json"));
    ASSERT_REFUSED("--region", "needs x,y,width,height");
    assert_false(READ("render", "--region", "1,2,3.5,4", "a.json"));
    ASSERT_REFUSED("--region", "3.5 is not a whole number");
    assert_false(READ("render", "--aov", "color,,id", "a.json"));
    ASSERT_REFUSED("--aov", "'' is none of color, depth, normal, position, id, steps, albedo, "
                            "specular, optical, shadow, occlusion");
    assert_false(READ("render", "--width=0", "a.json"));
    ASSERT_REFUSED("--width", "0 is below the minimum 1");
}

static void vectors_and_choices_have_numbers(void **state)
{
    (void)state;
    assert_true(READ("render", "--camera-position", "-1,2.5,3e1", "--aov=depth", "a.json"));
    const double *position = option_vector(&options, OPTION_CAMERA_POSITION);
    assert_true(position[0] == -1 && position[1] == 2.5 && position[2] == 30);
    assert_null(option_vector(&options, OPTION_CAMERA_TARGET));
    assert_int_equal(option_int(&options, OPTION_AOV), 1 << AOV_DEPTH);
    assert_true(READ("render", "--aov", "normal,color", "--region", "1,2,30,40", "a.json"));
    assert_int_equal(option_int(&options, OPTION_AOV), 1 << AOV_NORMAL | 1 << AOV_COLOR);
    assert_int_equal(option_vector(&options, OPTION_REGION)[3], 40);
    assert_null(option_text(&options, OPTION_LEVEL));
    assert_string_equal(options.operands[0], "a.json");
}

static void names_are_checked(void **state)
{
    (void)state;
    assert_false(READ("serve", "--prot", "1"));
    ASSERT_REFUSED("--prot", "is no option of fieldcast serve; did you mean \"port\"?");
    assert_false(READ("serve", "--width", "1"));
    ASSERT_REFUSED("--width", "is no option of fieldcast serve");
    assert_false(READ("serve", "-port", "1"));
    ASSERT_REFUSED("-port", "is no option of fieldcast serve; did you mean \"port\"?");
    assert_false(READ("render", "--o", "x", "a.json"));
    assert_false(READ("serve", "--port"));
    ASSERT_REFUSED("--port", "needs a value: PORT");
}

static void operands_are_counted(void **state)
{
    (void)state;
    assert_false(READ("serve", "x"));
    ASSERT_REFUSED("serve", "does not take 'x'");
    assert_false(read_as("render", no_arguments));
    ASSERT_REFUSED("render", "needs SCENE.json");
    assert_false(READ("render", "a", "b"));
    ASSERT_REFUSED("render", "does not take 'b'");
    assert_true(READ("check", "a", "b", "c"));
    assert_int_equal(options.operand_count, 3);
    assert_true(READ("render", "-o", "-", "--", "--odd name"));
    assert_string_equal(options.operands[0], "--odd name");
    assert_string_equal(option_text(&options, OPTION_OUTPUT), "-");
}

static void help_asks_for_nothing_else(void **state)
{
    (void)state;
    setenv("FIELDCAST_PORT", "nonsense", 1);
    assert_true(READ("serve", "--help"));
    assert_true(option_flag(&options, OPTION_HELP));
    assert_true(READ("render", "-h"));
    assert_true(option_flag(&options, OPTION_HELP));
}

static void other_sources_name_their_place(void **state)
{
    (void)state;
    char place[64];

    setenv("FIELDCAST_PORT", "x", 1);
    assert_false(read_as("serve", no_arguments));
    ASSERT_REFUSED("FIELDCAST_PORT", "'x' is not a number");
    unsetenv("FIELDCAST_PORT");

    write_config("\nport = x\n");
    assert_false(READ("serve", "--config", config_path));
    snprintf(place, sizeof place, "%s:2: port", config_path);
    ASSERT_REFUSED(place, "'x' is not a number");
    write_config("prot = 1\n");
    assert_false(READ("serve", "--config", config_path));
    snprintf(place, sizeof place, "%s:1: prot", config_path);
    ASSERT_REFUSED(place, "is no option of the config file; did you mean \"port\"?");
    write_config("width = 1\n");
    assert_false(READ("serve", "--config", config_path));
    write_config("port 1\n");
    assert_false(READ("serve", "--config", config_path));
    snprintf(place, sizeof place, "%s:1", config_path);
    ASSERT_REFUSED(place, "expected `name = value`");
    assert_false(READ("serve", "--config", "/nowhere/fieldcast.conf"));
    ASSERT_REFUSED("/nowhere/fieldcast.conf", "No such file or directory");
}

/* What is asked of a picture is asked by an option of its name, within the same range. */
static void members_of_a_request_have_options(void **state)
{
    static const struct {
        const struct record_type *type;
        const char *prefix;
    } types[] = {{&picture_type, ""}, {&camera_type, "camera-"}, {&section_type, "section-"}};
    (void)state;
    for (size_t t = 0; t < sizeof types / sizeof types[0]; t++) {
        for (const struct param *param = types[t].type->params; param->name; param++) {
            char name[64];
            snprintf(name, sizeof name, "%s%s", types[t].prefix, param->name);
            const enum option option = option_find(name);
            if (option == OPTION_COUNT) {
                fail_msg("there is no option --%s", name);
            }
            const struct option_row *row = option_row(option);
            if (row->type == OPTION_INT) {
                assert_true(row->min == param->min && row->max == param->max);
            }
        }
    }
    assert_int_equal(option_find("nothing"), OPTION_COUNT);
}

int main(void)
{
    const int fd = mkstemp(config_path);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(table_is_consistent, set_up, tear_down),
        cmocka_unit_test_setup_teardown(every_command_reads_its_defaults, set_up, tear_down),
        cmocka_unit_test_setup_teardown(defaults_stand_in_the_home_directory, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_nearest_source_wins, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_environment_names_the_config_file, set_up, tear_down),
        cmocka_unit_test(members_of_a_request_have_options),
        cmocka_unit_test_setup_teardown(values_are_checked, set_up, tear_down),
        cmocka_unit_test_setup_teardown(vectors_and_choices_have_numbers, set_up, tear_down),
        cmocka_unit_test_setup_teardown(names_are_checked, set_up, tear_down),
        cmocka_unit_test_setup_teardown(operands_are_counted, set_up, tear_down),
        cmocka_unit_test_setup_teardown(help_asks_for_nothing_else, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_sources_name_their_place, set_up, tear_down),
    };
    const int failed = fd < 0 ? 1 : cmocka_run_group_tests(tests, NULL, NULL);

    close(fd);
    unlink(config_path);
    return failed;
}
