// Broken scenes, with the message and the place that each must report.

#include "render/load/mitsuba_xml.h"
#include "tests/load/temporary_folder.h"

#include <functional>

#include <gtest/gtest.h>

namespace tessera {

namespace {

struct Broken {
    const char* name;
    const char* body;    // contents of <scene version="3.0.0">, which begin on line 2
    const char* message; // expected after "b.xml:"
};

constexpr Broken broken_scenes[] = {
    {"unknown variable", "<integrator type='path'><integer name='max_depth' value='$deep'/></integrator>",
     "2:58: the variable '$deep' is not defined"},
    {"variable before its default", "<bsdf type='$k'/><default name='k' value='diffuse'/>",
     "2:13: the variable '$k' is not defined"},
    {"default without value", "<default name='k'/>", "2:1: <default> needs the attribute 'value'"},
    {"plugin without type", "<bsdf id='a'/>", "2:1: <bsdf> needs the attribute 'type'"},
    {"undefined ref", "<shape type='cube'>\n  <ref id='wood'/></shape>",
     "3:12: nothing in the file has the id 'wood'"},
    {"ref without id", "<shape type='cube'><ref/></shape>", "2:20: <ref> needs the attribute 'id'"},
    {"alias of an unknown id", "<alias id='x' as='y'/>", "2:12: nothing in the file has the id 'x'"},
    {"id twice", "<bsdf type='diffuse' id='a'/>\n<shape type='cube' id='a'/>",
     "3:24: the id 'a' is already used by the <bsdf> at b.xml:2:1"},
    {"circle of references", "<bsdf type='twosided' id='a'><ref id='a'/></bsdf>",
     "2:1: nested too deep: is this a circle of references?"},
    {"not a number", "<bsdf type='roughconductor'><float name='alpha' value='0.1x'/></bsdf>",
     "2:56: '0.1x' is not a number"},
    {"infinite number", "<bsdf type='roughconductor'><float name='alpha' value='inf'/></bsdf>",
     "2:56: 'inf' is not a number"},
    {"number too large", "<bsdf type='roughconductor'><float name='alpha' value='1e39'/></bsdf>",
     "2:56: '1e39' is not a number"},
    {"empty number", "<bsdf type='roughconductor'><float name='alpha' value=''/></bsdf>",
     "2:56: '' is not a number"},
    {"number without value", "<bsdf type='roughconductor'><float name='alpha'/></bsdf>",
     "2:29: <float> needs the attribute 'value'"},
    {"negative roughness", "<bsdf type='roughconductor'><float name='alpha' value='-1'/></bsdf>",
     "2:56: 'alpha' must not be negative"},
    {"not an integer", "<integrator type='path'><integer name='max_depth' value='2.5'/></integrator>",
     "2:58: '2.5' is not an integer"},
    {"max_depth of 0", "<integrator type='path'><integer name='max_depth' value='0'/></integrator>",
     "2:58: 'max_depth' must be at least 1, or -1 for no limit"},
    {"wrong type", "<integrator type='path'><float name='max_depth' value='2'/></integrator>",
     "2:25: 'max_depth' must be of type <integer>, not <float>"},
    {"boolean that is neither true nor false",
     "<shape type='cube'><boolean name='flip_normals' value='yes'/></shape>",
     "2:56: 'yes' is neither 'true' nor 'false'"},
    {"two numbers for a colour", "<bsdf type='diffuse'><rgb name='reflectance' value='1, 2'/></bsdf>",
     "2:53: '1, 2' must be one number or three"},
    {"colour with a word", "<bsdf type='diffuse'><rgb name='reflectance' value='1, red, 2'/></bsdf>",
     "2:53: '1, red, 2' is not a list of numbers"},
    {"bad hexadecimal colour", "<bsdf type='diffuse'><rgb name='reflectance' value='#12345g'/></bsdf>",
     "2:53: '#12345g' is not a colour such as '#a0b0c0'"},
    {"a colour that is a string", "<bsdf type='diffuse'><string name='reflectance' value='red'/></bsdf>",
     "2:22: 'reflectance' must be a colour, not <string>"},
    {"negative reflectance", "<bsdf type='diffuse'><rgb name='reflectance' value='-0.1'/></bsdf>",
     "2:53: 'reflectance' must not be negative"},
    {"spectrum out of order", "<bsdf type='diffuse'><spectrum name='reflectance' value='500:1, 400:1'/></bsdf>",
     "2:58: the wavelengths of a spectrum must increase"},
    {"negative radiance",
     "<shape type='cube'><emitter type='area'><rgb name='radiance' value='-1'/></emitter></shape>",
     "2:69: 'radiance' must not be negative"},
    {"unknown material", "<bsdf type='dielectric'><string name='int_ior' value='cheese'/></bsdf>",
     "2:55: the index of refraction of 'cheese' is not known"},
    {"index of refraction of 0", "<bsdf type='dielectric'><float name='int_ior' value='0'/></bsdf>",
     "2:54: an index of refraction must be above 0"},
    {"twosided without a material", "<bsdf type='twosided'/>", "2:1: 'twosided' needs a nested <bsdf>"},
    {"short matrix", "<shape type='cube'><transform name='to_world'><matrix value='1 0 0'/></transform></shape>",
     "2:62: a matrix has 16 numbers, or 9; here are 3"},
    {"unknown step of a transform",
     "<shape type='cube'><transform name='to_world'><twist x='1'/></transform></shape>",
     "2:47: <twist> is not a step of a transform"},
    {"rotation without an axis",
     "<shape type='cube'><transform name='to_world'><rotate angle='1'/></transform></shape>",
     "2:47: a rotation needs an axis"},
    {"lookat with target at origin",
     "<sensor type='perspective'><transform name='to_world'><lookat origin='1,2,3' target='1,2,3'/></transform>"
     "</sensor>",
     "2:86: origin and target of a lookat are the same point"},
    {"flat camera", "<sensor type='perspective'><transform name='to_world'><scale z='0'/></transform></sensor>",
     "2:28: the camera's transform is flat"},
    {"field of view of 180 degrees", "<sensor type='perspective'><float name='fov' value='180'/></sensor>",
     "2:53: the field of view must be between 0 and 180 degrees"},
    {"unknown axis of the field of view",
     "<sensor type='perspective'><float name='fov' value='9'/><string name='fov_axis' value='w'/></sensor>",
     "2:88: 'w' is not an axis (x, y, diagonal, smaller or larger)"},
    {"lens without a radius", "<sensor type='thinlens'/>",
     "2:1: the sensor 'thinlens' needs an 'aperture_radius'"},
    {"negative radius", "<sensor type='thinlens'><float name='aperture_radius' value='-1'/></sensor>",
     "2:62: 'aperture_radius' must not be negative"},
    {"focus on the lens",
     "<sensor type='thinlens'><float name='aperture_radius' value='1'/>\n<float name='focus_distance' value='0'/>"
     "</sensor>",
     "3:37: 'focus_distance' must be above 0"},
    {"film that is too wide",
     "<sensor type='perspective'><film type='hdrfilm'>\n<integer name='width' value='100000000'/></film></sensor>",
     "3:30: the film's width must be from 1 to 16384"},
    {"film without pixels",
     "<sensor type='perspective'><film type='hdrfilm'><integer name='height' value='0'/></film></sensor>",
     "2:79: the film's height must be from 1 to 16384"},
    {"mesh without file name", "<shape type='ply'/>", "2:1: 'ply' needs a 'filename'"},
    {"file name in a scene in memory", "<shape type='ply'><string name='filename' value='a.ply'/></shape>",
     "2:50: a scene in memory has no files beside it, such as 'a.ply'"},
    {"raw constant without a value",
     "<bsdf type='diffuse'><texture name='reflectance' type='rawconstant'/></bsdf>",
     "2:22: 'rawconstant' needs a 'value'"},
    {"attribute without a name", "<bsdf type='diffuse'><texture name='reflectance' type='mesh_attribute'/></bsdf>",
     "2:22: 'mesh_attribute' needs a 'name'"},
    {"attribute without a prefix",
     "<bsdf type='diffuse'><texture name='reflectance' type='mesh_attribute'>\n<string name='name' value='color'/>"
     "</texture></bsdf>",
     "3:28: 'color' is not an attribute: its name must begin with 'vertex_' or 'face_'"},
    {"blackbody without temperature",
     "<shape type='cube'><emitter type='area'><blackbody name='radiance'/></emitter></shape>",
     "2:41: <blackbody> needs the attribute 'temperature'"},
    {"black body of 0 K",
     "<shape type='cube'><emitter type='area'><blackbody name='radiance' temperature='0K'/></emitter></shape>",
     "2:41: the temperature of a black body must be above 0"},
    {"black body that is too bright",
     "<shape type='cube'><emitter type='area'><blackbody name='radiance' temperature='1e38' scale='1e30'/>"
     "</emitter></shape>",
     "2:41: the black body is too bright"},
    {"values without wavelengths",
     "<bsdf type='diffuse'><spectrum name='reflectance' type='irregular'><string name='values' value='1, 2'/>"
     "</spectrum></bsdf>",
     "2:22: 'irregular' needs as many 'wavelengths' as 'values', lists of numbers"},
    {"spectrum of huge numbers",
     "<bsdf type='diffuse'><spectrum name='reflectance' value='400:3e38, 700:3e38'/></bsdf>",
     "2:58: the spectrum's numbers are too large"},
    {"sphere of radius 0", "<shape type='sphere'><float name='radius' value='0'/></shape>",
     "2:50: the radius must be above 0"},
    {"cylinder of length 0",
     "<shape type='cylinder'><point name='p0' x='1'/><point name='p1' value='1 0 0'/></shape>",
     "2:1: p0 and p1 of a cylinder are the same point"},
    {"point that is a number", "<shape type='sphere'><float name='center' value='1'/></shape>",
     "2:22: 'center' must be of type <point>, not <float>"},
    {"point of two numbers", "<shape type='sphere'><point name='center' value='1, 2'/></shape>",
     "2:50: '1, 2' must be three numbers"},
    {"huge sphere",
     "<shape type='sphere'><float name='radius' value='1e38'/><transform name='to_world'><scale value='10'/>"
     "</transform></shape>",
     "2:1: the transform of the shape must be finite and have an inverse"},
    {"flat cylinder", "<shape type='cylinder'><transform name='to_world'><scale x='0'/></transform></shape>",
     "2:1: the transform of the shape must be finite and have an inverse"},
    {"huge cube",
     "<shape type='cube'><transform name='to_world'><matrix value='3e38 3e38 0 0  0 1 0 0  0 0 1 0  0 0 0 1'/>"
     "</transform></shape>",
     "2:1: the position of vertex "},
    {"negative index of a mesh",
     "<shape type='serialized'><string name='filename' value='a'/><integer name='shape_index' "
     "value='-1'/></shape>",
     "2:96: 'shape_index' must not be negative"},
    {"circle of textures",
     "<texture type='scale' id='a'><ref id='b'/></texture><texture type='scale' id='b'><ref id='a'/></texture>"
     "<bsdf type='diffuse'><ref name='reflectance' id='a'/></bsdf>",
     "2:53: nested too deep: is this a circle of references?"},
    {"circle of aliases", "<alias id='a' as='b'/><alias id='b' as='a'/>",
     "2:12: nothing in the file has the id 'a'"},
    {"circle of integrators", "<integrator type='aov' id='a'><ref id='a'/></integrator>",
     "2:1: nested too deep: is this a circle of references?"},
    {"include in memory", "<include filename='a.xml'/>",
     "2:20: a scene in memory has no files beside it, such as 'a.xml'"},
    {"huge transform",
     "<shape type='cube'><transform name='to_world'><scale value='1e30'/><scale "
     "value='1e30'/></transform></shape>",
     "2:20: the transform's numbers are too large"},
};

/// Returns the error message, or "no error".
std::string error_of(const std::string& xml) {
    try {
        parse_mitsuba_xml(xml, "b.xml", {}, serial_for, nullptr, true);
    } catch (const LoadError& e) {
        return e.what();
    }
    return "no error";
}

std::string error_of_file(const std::filesystem::path& file) {
    try {
        load_mitsuba_xml(file, {}, serial_for, nullptr, true);
    } catch (const LoadError& e) {
        return e.what();
    }
    return "no error";
}

std::string scene_with(const std::string& body) {
    return "<scene version='3.0.0'>\n" + body + "\n</scene>\n";
}

} // namespace

TEST(BrokenScenes, EachErrorHasItsMessageAndPlace) {
    for (const Broken& broken : broken_scenes) {
        const std::string message = error_of(scene_with(broken.body));
        const std::string expected = std::string("b.xml:") + broken.message;
        EXPECT_EQ(message.substr(0, expected.size()), expected) << broken.name;
        EXPECT_TRUE(message.ends_with("^")) << broken.name << ": " << message;
    }
}

TEST(BrokenScenes, RejectsMalformedXml) {
    EXPECT_EQ(error_of("<scene>\n  <bsdf type='diffuse'>\n</scene>").substr(0, 43),
              "b.xml:3:3: the XML is broken: Start-end tag");
    EXPECT_EQ(error_of("").substr(0, 29), "b.xml:1:1: the XML is broken:");
    EXPECT_EQ(error_of("no XML at all").substr(0, 6), "b.xml:");
    EXPECT_EQ(error_of("<scene version='3.0.0'><bsdf ").substr(0, 6), "b.xml:");
    EXPECT_EQ(error_of("<sphere/>").substr(0, 63),
              "b.xml:1:1: a scene file begins with <scene>, not with <sphere>\n");
    EXPECT_EQ(error_of("<scene version='new'/>").substr(0, 37), "b.xml:1:17: 'new' is not a version\n  ");
    EXPECT_EQ(error_of(std::string("<scene>\0</scene>", 16)).substr(0, 6), "b.xml:");
}

TEST(BrokenScenes, EveryTruncationIsAnError) {
    const std::string whole =
        scene_with("<default name='a' value='2'/><!-- c --><bsdf type='twosided' id='m'>"
                   "<bsdf type='diffuse'><rgb name='reflectance' value='#102030'/></bsdf></bsdf>"
                   "<shape type='cube'><transform name='to_world'><scale value='$a'/>"
                   "</transform><ref id='m'/></shape>");
    EXPECT_EQ(error_of(whole), "no error");
    for (std::size_t length = 0; length + 2 < whole.size(); ++length)
        EXPECT_EQ(error_of(whole.substr(0, length)).substr(0, 6), "b.xml:") << length;
}

TEST(BrokenScenes, ErrorsShowTheLineWithACaret) {
    EXPECT_EQ(error_of("<scene version='3.0.0'>\n\t<shape type='cube'><ref id='wood'/></shape>\n</scene>"),
              "b.xml:2:30: nothing in the file has the id 'wood'\n"
              "     <shape type='cube'><ref id='wood'/></shape>\n"
              "                                 ^");
    // Long lines are shortened to the text around the caret.
    const std::string message = error_of("<scene version='3.0.0'>" + std::string(1000, ' ') + "<ref/><bsdf/>" +
                                         std::string(1000, ' ') + "</scene>");
    EXPECT_LT(message.size(), 500u);
    const std::size_t line = message.find("\n    ") + 5;
    const std::size_t caret = message.rfind('^') - (message.rfind("\n    ") + 5);
    EXPECT_EQ(message.substr(line + caret, 5), "<bsdf");
}

TEST(BrokenScenes, RejectsDeepNesting) {
    std::string deep;
    for (int i = 0; i < 100000; ++i)
        deep += "<bsdf type='twosided'>";
    EXPECT_EQ(error_of("<scene>" + deep).substr(0, 6), "b.xml:");
    for (int i = 0; i < 100000; ++i)
        deep += "</bsdf>";
    EXPECT_NE(error_of(scene_with(deep)).find("nested too deep"), std::string::npos);
}

TEST(BrokenScenes, ErrorsNameMissingAndBrokenFiles) {
    const TemporaryFolder folder;
    const auto path = [&](const char* name) { return (folder.path() / name).string(); };
    EXPECT_EQ(error_of_file(folder.path() / "none.xml"),
              path("none.xml") + ": cannot open the file: No such file or directory");
    EXPECT_EQ(error_of_file(folder.path()), folder.path().string() + ": this is a folder, not a file");

    folder.write("cut.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                            "property float z\nend_header\n0.0 0.0 0.0\n1.0 1.0\n");
    folder.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n");
    folder.write("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 1 3 4\n");
    folder.write("no-image.png", "not an image");
    folder.write("far.obj", "v 1e38 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto shape = [&](const std::string& type, const std::string& file) {
        return folder.write("s.xml",
                            scene_with("<shape type='" + type + "'><string name='filename' value='" + file +
                                       "'/><transform name='to_world'><scale value='10'/></transform></shape>"));
    };
    const auto expect = [&](const std::filesystem::path& scene, const std::string& message) {
        EXPECT_EQ(error_of_file(scene).substr(0, path("s.xml").size() + 1 + message.size()),
                  path("s.xml") + ":" + message);
    };
    expect(shape("obj", "a.obj"), "2:50: there is no file 'a.obj'");
    expect(shape("obj", "."), "2:50: '.' is not a file");
    expect(shape("ply", "cut.ply"), "2:50: cannot load 'cut.ply': vertex 1: the file ends too early");
    expect(shape("ply", "nan.obj"), "2:50: cannot load 'nan.obj': line 1: the file does not begin with 'ply'");
    expect(shape("obj", "nan.obj"), "2:50: 'nan.obj': 1 position not finite: 1 triangle left out");
    expect(shape("obj", "index.obj"),
           "2:50: cannot load 'index.obj': face 2 refers to position 4, but there are 3 before it");
    folder.write("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto smooth = [&](const std::string& parameters) {
        return folder.write("s.xml", scene_with("<shape type='obj'><string name='filename' value='good.obj'/>\n" +
                                                parameters + "</shape>"));
    };
    expect(smooth("<float name='maxSmoothAngle' value='181'/>"),
           "3:37: 'max_smooth_angle' must be from 0 to 180 degrees");
    expect(smooth("<float name='maxSmoothAngle' value='9'/><boolean name='faceNormals' value='true'/>"),
           "3:1: 'max_smooth_angle' and 'face_normals' exclude each other");
    expect(shape("obj", "far.obj"), "2:50: cannot load 'far.obj': the position of vertex 0 is not finite");
    expect(folder.write("s.xml", scene_with("<bsdf type='diffuse'><texture name='reflectance' type='bitmap'>"
                                            "<string name='filename' value='no-image.png'/></texture></bsdf>")),
           "2:95: cannot load 'no-image.png': it is not an OpenEXR");
}

TEST(BrokenScenes, ReportsTheFirstOfSeveralErrors) {
    const TemporaryFolder folder;
    folder.write("a.obj", "v 0 0 x\n");
    folder.write("b.obj", "v 0\n");
    const auto file =
        folder.write("s.xml", scene_with("<shape type='obj'><string name='filename' value='b.obj'/></shape>"
                                         "\n<shape type='obj'><string name='filename' value='a.obj'/>"
                                         "</shape>"));
    const auto backwards = [](int count, const std::function<void(int)>& body) {
        for (int i = count; i-- > 0;)
            body(i);
    };
    try {
        load_mitsuba_xml(file, {}, backwards, nullptr, true);
        FAIL();
    } catch (const LoadError& e) {
        EXPECT_NE(std::string(e.what()).find("s.xml:2:50: cannot load 'b.obj'"), std::string::npos) << e.what();
    }
}

} // namespace tessera
