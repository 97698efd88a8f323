/* host.c - a program that compiles a graph, runs it and reads what it made, by libpcg.
 *
 *     cc -o host examples/host.c $(pkg-config --cflags --libs libpcg)
 *     ./host examples/house.pcg 12m
 */
#include <pcg.h>
#include <stdio.h>

static void print_message(void *user, const pcg_message *m)
{
    fputs(m->rendered, user);
}

int main(int argc, char **argv)
{
    const pcg_compile_options options = {
        .size = sizeof options, .message = print_message, .user = stderr};
    pcg_program *house = argc == 3 ? pcg_compile_file(argv[1], &options) : NULL;
    if (!house)
        return 2;
    pcg_run *run = pcg_run_new(house, NULL);
    pcg_mesh_view mesh = {.size = sizeof mesh};
    int failed = pcg_run_set(run, "height", argv[2]) != PCG_STATUS_OK ||
                 pcg_run_execute(run) != PCG_STATUS_OK;
    if (failed)
        fprintf(stderr, "%s\n", pcg_run_error(run));
    for (size_t i = 0; i < pcg_program_output_count(house) && !failed; i++)
        if (pcg_run_output_mesh(run, i, &mesh) == PCG_STATUS_OK)
            printf("%zu polygons, %zu triangles\n", mesh.face_count, mesh.triangle_count);
    pcg_run_free(run);
    pcg_program_free(house);
    return failed;
}
