/** How a call of this C API over roscpp ended. No function of it throws a C++ exception. */
#ifndef HDLYAP_ROS_STATUS_H
#define HDLYAP_ROS_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/** How a call ended. HDR_MUST_CHECK makes the compiler warn if it is ignored. */
typedef enum hdr_status {
    HDR_OK,
    HDR_MISSING,    /**< there is no such parameter */
    HDR_WRONG_TYPE, /**< the parameter has another type */
    HDR_NO_MEMORY,  /**< no memory, or no thread can start; hdr_error_text says which */
    HDR_FAULT,      /**< ROS refused or failed; hdr_error_text says why */
    HDR_NOT_FINITE  /**< a number in a message is not finite, but must be */
} hdr_status;

#if defined(__GNUC__)
#define HDR_MUST_CHECK __attribute__((warn_unused_result))
#else
#define HDR_MUST_CHECK
#endif

/** Text, one line, of the last HDR_FAULT, HDR_NO_MEMORY or HDR_NOT_FINITE on this thread. It is
 * never NULL, and valid until the next one. */
const char *hdr_error_text(void);

#ifdef __cplusplus
}
#endif
#endif
