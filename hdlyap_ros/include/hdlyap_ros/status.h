/** The outcome of each call of this C API over roscpp. None of its functions throws a C++
 * exception.
 */
#ifndef HDLYAP_ROS_STATUS_H
#define HDLYAP_ROS_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum hdr_status {
    HDR_OK,
    HDR_MISSING,    /**< there is no such parameter */
    HDR_WRONG_TYPE, /**< the parameter has another type */
    HDR_NO_MEMORY,  /**< no memory, or no thread; hdr_error_text says which */
    HDR_FAULT,      /**< roscpp refused; hdr_error_text says why */
    HDR_NOT_FINITE  /**< a number of a message is not finite, but must be */
} hdr_status;

#if defined(__GNUC__)
#define HDR_MUST_CHECK __attribute__((warn_unused_result))
#else
#define HDR_MUST_CHECK
#endif

/** Text of the last HDR_FAULT, HDR_NO_MEMORY or HDR_NOT_FINITE of this thread. It is never NULL,
 * and valid until the next one. */
const char *hdr_error_text(void);

#ifdef __cplusplus
}
#endif
#endif
