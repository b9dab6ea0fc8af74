// The journal of experiments: its files keep what is written, and truncated files keep their whole lines.
#include "app/experiment/result.h"
#include "tests/load/temporary_folder.h"

#include <filesystem>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::test {

namespace {

using nlohmann::json;

class JournalFile : public testing::Test {
protected:
    /// Returns the journal read from a file with this text.
    Journal journal_of(const std::string& text) {
        folder_.write("a.jsonl", text);
        Journal journal;
        journal.read(folder_.path() / "a.jsonl");
        return journal;
    }
    TemporaryFolder folder_;
};

TEST_F(JournalFile, KeepsWhatIsWritten) {
    Journal journal =
        journal_of(Journal::line({{"seed", 1}, {"scene", "box"}}, {1.5, nullptr}) +
                   Journal::line({{"seed", 2}}, "two\nlines") + Journal::line({{"seed", 2}}, "again"));
    EXPECT_EQ(journal.find({{"scene", "box"}, {"seed", 1}}), json({1.5, nullptr}));
    EXPECT_EQ(journal.find({{"seed", 2}}), "again") << "the last value applies";
    EXPECT_TRUE(journal.find({{"seed", 3}}).is_null());
    folder_.write("b.jsonl", Journal::line({{"seed", 3}}, 30) + Journal::line({{"seed", 2}}, 20));
    journal.read(folder_.path() / "b.jsonl");
    EXPECT_EQ(journal.find({{"seed", 2}}), 20);
    EXPECT_EQ(journal.find({{"seed", 3}}), 30);
}

TEST_F(JournalFile, ReplacesInvalidUtf8) {
    const json key{{"scene", "sc\xe8ne"}};
    EXPECT_EQ(journal_of(Journal::line(key, "caf\xe9")).find(key), "caf\xef\xbf\xbd");
}

/// A file truncated after any number of bytes keeps its whole lines.
TEST_F(JournalFile, IgnoresATruncatedLine) {
    const std::string first = Journal::line({{"seed", 1}}, 10), whole = first + Journal::line({{"seed", 2}}, 20);
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        const Journal journal = journal_of(whole.substr(0, length));
        EXPECT_EQ(journal.find({{"seed", 1}}).is_null(), length < first.size()) << length;
        EXPECT_EQ(journal.find({{"seed", 2}}).is_null(), length != whole.size()) << length;
    }
}

TEST_F(JournalFile, IgnoresForeignLines) {
    EXPECT_EQ(journal_of("hello\n[]\n{\"key\":1}\n\n{\"key\":{\"seed\":1},\"value\":2}\n").find({{"seed", 1}}), 2);
}

TEST_F(JournalFile, ThrowsIfItCannotBeRead) {
    EXPECT_THROW(Journal().read(folder_.path()), std::runtime_error);
    EXPECT_THROW(Journal().read(folder_.path() / "none.jsonl"), std::runtime_error);
}

} // namespace

} // namespace tessera::test
