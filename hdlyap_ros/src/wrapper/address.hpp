/** Whether a node answers at its address; private to the wrapper. */
#pragma once

#include <memory>
#include <mutex>
#include <string>

/** What an address must be, for the user. */
extern const char *const address_must_be;

/** Whether the node at this address of XML-RPC answers within so many seconds, but for the time
 * that its name takes to be looked up. */
bool address_answers(const std::string &address, double seconds);

/** Asks from a separate thread, as looking up a name may take long, whether this node answers at
 * its own address, and warns if not. */
class hdr_own_address
{
  public:
    /** Throws std::system_error if no thread can be created. */
    hdr_own_address();
    ~hdr_own_address();
    hdr_own_address(const hdr_own_address &) = delete;
    hdr_own_address &operator=(const hdr_own_address &) = delete;

  private:
    /** Belongs to the thread too, which may outlive the node. */
    struct asked {
        std::mutex mutex;
        bool wanted = true;
        void ask(const std::string &address);
    };
    std::shared_ptr<asked> shared;
};
