/* Options: by number and by name, which there are, and what is refused. */
#include <stdio.h>
#include <tetstream/tetstream.h>

int main(void) {
  tetstream_options* options = NULL;
  if (tetstream_options_create(&options) < 0) return 1;

  /* A program knows numbers. The first target that is reached ends a run. */
  tetstream_options_set_double(options, TETSTREAM_OPTION_RATIO, 0.25);
  tetstream_options_set_double(options, TETSTREAM_OPTION_ERROR, 0.5);
  tetstream_options_set_text(options, TETSTREAM_OPTION_SHAPE, "solver");
  /* A file of settings has names and texts, as the command line does. */
  tetstream_options_parse(options, "memory", "64M");
  /* Of the fields only these are followed, the first four times as closely. */
  tetstream_options_add_field(options, "pressure", 4);
  tetstream_options_add_field(options, "velocity", 1);

  int64_t memory = 0;
  tetstream_options_get_int64(options, TETSTREAM_OPTION_MEMORY, &memory);
  printf("memory is %lld bytes\n", (long long)memory);

  /* What is refused changes nothing. */
  if (tetstream_options_set_double(options, TETSTREAM_OPTION_RATIO, 25) < 0)
    printf("refused: %s\n", tetstream_options_message(options));
  if (tetstream_options_parse(options, "ration", "0.25") < 0)
    printf("refused: %s\n", tetstream_options_message(options));
  double ratio = 0;
  tetstream_options_get_double(options, TETSTREAM_OPTION_RATIO, &ratio);
  printf("ratio is still %g\n", ratio);

  /* All of them, also those of a library that is newer than this program. */
  for (int32_t i = 0; i < tetstream_option_count(); ++i) {
    tetstream_option_info row = {.struct_size = sizeof row};
    if (tetstream_option_at(i, &row) < 0) break;
    printf("  %d %s (%s): %s\n", (int)row.id, row.name, row.default_text, row.text);
  }
  tetstream_options_destroy(options);
  return 0;
}
