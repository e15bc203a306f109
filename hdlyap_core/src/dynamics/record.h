/** What the core does with records. */
#ifndef HD_RECORD_H
#define HD_RECORD_H

#include "hdlyap/record.h"

/** Empty; entry: bytes of one, a multiple of those of a double. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_record_create(hd_record **out, size_t entry);
void hd_record_free(hd_record *record);
/** Empties the record: it begins anew where the particles are. Its room stays. */
void hd_record_clear(hd_record *record);

/** Bytes of a record of so many entries. */
double hd_record_bytes(double entries, size_t entry);

#endif
