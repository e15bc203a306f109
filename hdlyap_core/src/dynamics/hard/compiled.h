/** The sources of this folder are compiled four times: for disks in the plane (HD_DIM = 2) and for
 * spheres in space (3), and for each of them once for particles that are all alike and once
 * (HD_MIXED = 1) for those of two sizes and masses, whose numbers are constants in the first. All
 * are in one library, so each function that is declared in a header gets a different name in each.
 */
#ifndef HD_HARD_COMPILED_H
#define HD_HARD_COMPILED_H

#if HD_DIM != 2 && HD_DIM != 3
#error "HD_DIM: must be 2 or 3"
#endif

#ifndef HD_MIXED
#define HD_MIXED 0
#endif

/** Components of a tangent vector that belong to one particle: dq, then dp. */
enum { HD_ROWS = 2 * HD_DIM };

#if HD_MIXED
#define HD_COMPILED__(name, dimension) name##_##dimension##d_mixed
#else
#define HD_COMPILED__(name, dimension) name##_##dimension##d
#endif
#define HD_COMPILED_(name, dimension) HD_COMPILED__(name, dimension)
#define HD_COMPILED(name) HD_COMPILED_(name, HD_DIM)

#define hd_cells_add HD_COMPILED(hd_cells_add)
#define hd_cells_book HD_COMPILED(hd_cells_book)
#define hd_cells_clear HD_COMPILED(hd_cells_clear)
#define hd_cells_create HD_COMPILED(hd_cells_create)
#define hd_cells_cross HD_COMPILED(hd_cells_cross)
#define hd_cells_empty HD_COMPILED(hd_cells_empty)
#define hd_events_bytes HD_COMPILED(hd_events_bytes)
#define hd_events_fault HD_COMPILED(hd_events_fault)
#define hd_hard_advance HD_COMPILED(hd_hard_advance)
#define hd_hard_archive HD_COMPILED(hd_hard_archive)
#define hd_hard_bytes HD_COMPILED(hd_hard_bytes)
#define hd_hard_clear HD_COMPILED(hd_hard_clear)
#define hd_hard_create HD_COMPILED(hd_hard_create)
#define hd_hard_create_empty HD_COMPILED(hd_hard_create_empty)
#define hd_hard_create_from HD_COMPILED(hd_hard_create_from)
#define hd_hard_entries HD_COMPILED(hd_hard_entries)
#define hd_hard_examine HD_COMPILED(hd_hard_examine)
#define hd_hard_fingerprint HD_COMPILED(hd_hard_fingerprint)
#define hd_hard_free HD_COMPILED(hd_hard_free)
#define hd_hard_grow HD_COMPILED(hd_hard_grow)
#define hd_hard_grow_check HD_COMPILED(hd_hard_grow_check)
#define hd_hard_inconsistency HD_COMPILED(hd_hard_inconsistency)
#define hd_hard_kinds HD_COMPILED(hd_hard_kinds)
#define hd_hard_share HD_COMPILED(hd_hard_share)
#define hd_hard_size HD_COMPILED(hd_hard_size)
#define hd_hard_keep HD_COMPILED(hd_hard_keep)
#define hd_hard_kinetic_energy HD_COMPILED(hd_hard_kinetic_energy)
#define hd_hard_least HD_COMPILED(hd_hard_least)
#define hd_hard_least_of HD_COMPILED(hd_hard_least_of)
#define hd_hard_overlap HD_COMPILED(hd_hard_overlap)
#define hd_hard_overlap_rounding HD_COMPILED(hd_hard_overlap_rounding)
#define hd_hard_predict HD_COMPILED(hd_hard_predict)
#define hd_hard_prepare HD_COMPILED(hd_hard_prepare)
#define hd_hard_rate HD_COMPILED(hd_hard_rate)
#define hd_hard_state HD_COMPILED(hd_hard_state)
#define hd_hard_time HD_COMPILED(hd_hard_time)
#define hd_hard_totals HD_COMPILED(hd_hard_totals)
#define hd_hard_with_walls HD_COMPILED(hd_hard_with_walls)
#define hd_hard_zeros HD_COMPILED(hd_hard_zeros)
#define hd_maps_carry HD_COMPILED(hd_maps_carry)
#define hd_maps_create HD_COMPILED(hd_maps_create)
#define hd_maps_fill HD_COMPILED(hd_maps_fill)
#define hd_maps_free HD_COMPILED(hd_maps_free)
#define hd_nearby_around HD_COMPILED(hd_nearby_around)
#define hd_nearby_beside HD_COMPILED(hd_nearby_beside)
#define hd_nearby_contacts HD_COMPILED(hd_nearby_contacts)
#define hd_nearby_listed HD_COMPILED(hd_nearby_listed)
#define hd_prediction_extend HD_COMPILED(hd_prediction_extend)
#define hd_prediction_renew HD_COMPILED(hd_prediction_renew)
#define hd_prefetch_ahead HD_COMPILED(hd_prefetch_ahead)
#define hd_queue_clear HD_COMPILED(hd_queue_clear)
#define hd_queue_create HD_COMPILED(hd_queue_create)
#define hd_queue_next HD_COMPILED(hd_queue_next)
#define hd_queue_put HD_COMPILED(hd_queue_put)
#define hd_queue_restart HD_COMPILED(hd_queue_restart)
#define hd_sizes_clear HD_COMPILED(hd_sizes_clear)
#define hd_sizes_create HD_COMPILED(hd_sizes_create)
#define hd_round_wall_reflect HD_COMPILED(hd_round_wall_reflect)

/* These are static, but the symbols by which clang chooses among their versions (HD_MULTIVERSION)
 * are not. */
#define carry_block HD_COMPILED(carry_block)
#define carry_block_with_walls HD_COMPILED(carry_block_with_walls)
#define listed_contacts HD_COMPILED(listed_contacts)

#endif
