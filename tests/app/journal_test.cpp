// The journal of long jobs: what it keeps, and what it makes of a file that was cut off anywhere.
#include "app/experiment/result.h"
#include "tests/load/temporary_folder.h"

#include <iterator>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::test {

namespace {

using nlohmann::json;

class JournalFile : public testing::Test {
protected:
    std::string text() const {
        std::ifstream in(file_);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "journal.jsonl";
};

TEST_F(JournalFile, KeepsWhatIsRecorded) {
    {
        Journal journal(file_);
        EXPECT_TRUE(journal.find({{"seed", 1}}).is_null());
        journal.record({{"seed", 1}, {"scene", "box"}}, {1.5, nullptr});
        journal.record({{"seed", 2}}, "two\nlines");
        journal.record({{"seed", 2}}, "again");
        EXPECT_FALSE(journal.find({{"scene", "box"}, {"seed", 1}}).is_null());
    }
    const Journal journal(file_);
    EXPECT_EQ(journal.find({{"scene", "box"}, {"seed", 1}}), json({1.5, nullptr}));
    EXPECT_EQ(journal.find({{"seed", 2}}), "again") << "the last counts";
    EXPECT_TRUE(journal.find({{"seed", 3}}).is_null());
}

TEST_F(JournalFile, NamesNeedNotBeUtf8) {
    const json key{{"scene", "sc\xe8ne"}};
    {
        Journal journal(file_);
        journal.record(key, "caf\xe9");
        EXPECT_FALSE(journal.find(key).is_null());
    }
    EXPECT_EQ(Journal(file_).find(key), "caf\xef\xbf\xbd");
}

/// Cut off after any number of bytes, the whole lines before count, and what is recorded next is whole, too.
TEST_F(JournalFile, GoesOnAfterATornLine) {
    {
        Journal journal(file_);
        journal.record({{"seed", 1}}, 10);
        journal.record({{"seed", 2}}, 20);
    }
    const std::string whole = text();
    const std::size_t first_line = whole.find('\n') + 1;
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        folder_.write("journal.jsonl", whole.substr(0, length));
        {
            Journal journal(file_);
            EXPECT_EQ(journal.find({{"seed", 1}}).is_null(), length < first_line) << length;
            EXPECT_EQ(journal.find({{"seed", 2}}).is_null(), length != whole.size()) << length;
            journal.record({{"seed", 3}}, 30);
        }
        const Journal again(file_);
        EXPECT_EQ(again.find({{"seed", 3}}), 30);
    }
}

TEST_F(JournalFile, LinesOfOthersDoNotCount) {
    folder_.write("journal.jsonl", "hello\n[]\n{\"key\":1}\n\n{\"key\":{\"seed\":1},\"value\":2}\n");
    EXPECT_EQ(Journal(file_).find({{"seed", 1}}), 2);
}

TEST_F(JournalFile, ThatCannotBeWrittenIsSaid) {
    EXPECT_THROW(Journal(folder_.path()), std::runtime_error);
    EXPECT_THROW(Journal(folder_.path() / "none/journal.jsonl"), std::runtime_error);
}

} // namespace

} // namespace tessera::test
