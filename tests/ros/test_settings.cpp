/** Ten thousand random sets of parameters, without ROS: each is accepted, or refused in one line
 * with its name. */
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <vector>

#include "fake_params.h"
#include "settings_fault.h"

namespace
{
constexpr int sets = 10000;
constexpr size_t bytes_max = 60; // some five parameters
constexpr size_t room_max = SETTINGS_ROOM_MAX;

std::vector<uint8_t> drawn(std::mt19937_64 &random)
{
    std::vector<uint8_t> bytes(random() % bytes_max);
    for (uint8_t &byte : bytes) byte = static_cast<uint8_t>(random());
    return bytes;
}

std::string hexadecimal(const std::vector<uint8_t> &bytes)
{
    std::string text;
    for (const uint8_t byte : bytes)
        for (const int digit : {byte >> 4, byte & 15}) text += "0123456789abcdef"[digit];
    return text;
}

TEST(Settings, EachSetIsAcceptedOrRefusedByName)
{
    std::mt19937_64 random(20260801);
    std::map<std::string, int> refused;
    int accepted = 0;
    for (int k = 0; k < sets; k++) {
        const std::vector<uint8_t> bytes = drawn(random);
        hdr_params *params = fake_params_create(bytes.data(), bytes.size());
        char line[SETTINGS_ROOM_MAX];
        const size_t room = k % 2 ? room_max : 1 + random() % room_max;
        const char *fault = settings_fault(params, k % 3 == 0, room, line);
        ASSERT_EQ(fault, nullptr) << fault << ": " << line << "\n" << hexadecimal(bytes);
        hdr_params_free(params);
        const std::string text(line), name = text.substr(0, text.find(" = "));
        accepted += text.empty();
        if (!text.empty()) refused[name]++;
    }
    std::cout << "of " << sets << " sets " << accepted << " accepted, the others refused by "
              << refused.size() << " names\n";
    EXPECT_GE(accepted, sets / 10);
    EXPECT_GE(sets - accepted, sets / 10);
}
} // namespace

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
