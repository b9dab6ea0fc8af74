// Tables with one entry for each enumerator. The compiler checks their size.
#include "recon/enumeration.h"
#include "recon/picture/reconstruct.h"

#include <gtest/gtest.h>

namespace tessera {

namespace {

enum class Colour : unsigned char { red, green, blue };
enum class Single { only };

template <class Table>
concept HasEntries = requires(const Table& table) { entry_of(table, Colour::red); };

static_assert(enumerator_count<Colour> == 3);
static_assert(enumerator_count<Single> == 1);
static_assert(enumerator_count<Norm> == 9);
static_assert(HasEntries<int[3]>);
static_assert(!HasEntries<int[2]> && !HasEntries<int[4]>, "a table needs exactly one entry for each enumerator");

TEST(Enumeration, EntriesAreInTheOrderOfTheValues) {
    constexpr const char* names[] = {"red", "green", "blue"};
    EXPECT_STREQ(entry_of(names, Colour::red), "red");
    EXPECT_STREQ(entry_of(names, Colour::blue), "blue");
}

} // namespace

} // namespace tessera
