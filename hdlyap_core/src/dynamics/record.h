/** Functions on records that only the core calls. */
#ifndef HD_RECORD_H
#define HD_RECORD_H

#include "hdlyap/record.h"

/** Creates an empty record; entry: bytes of an entry, a multiple of a double's. Fails with
 * HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_record_create(hd_record **out, size_t entry);
void hd_record_free(hd_record *record);
/** Empties the record, which then begins where the particles are now. Its memory stays. */
void hd_record_clear(hd_record *record);

/** Bytes of a record of so many entries. */
double hd_record_bytes(double entries, size_t entry);

#endif
