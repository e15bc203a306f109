/** Any bytes as private parameters: accepted or refused as settings_fault.h says. */
#include <stdio.h>
#include <stdlib.h>

#include "fake_params.h"
#include "settings_fault.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    hdr_params *params = fake_params_create(bytes, size);
    char line[SETTINGS_ROOM_MAX];
    const bool resumed = size > 0 && bytes[size - 1] % 4 == 0;
    const char *fault = settings_fault(params, resumed, sizeof line, line);
    if (fault) {
        fprintf(stderr, "%s: %s\n", fault, line);
        abort();
    }
    hdr_params_free(params);
    return 0;
}
