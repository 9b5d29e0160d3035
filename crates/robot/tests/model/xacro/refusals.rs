//! Refused descriptions in xacro: files outside of the packages, the limits, and the places of errors.

use std::fs;
use std::time::{Duration, Instant};

use groebot_robot::ErrorKind;
use groebot_robot::model::ReadOptions;
use tempfile::tempdir;

use super::{described, expand, expanded, write};

/// The kind and the message of an error, found within seconds.
fn refused(body: &str) -> (ErrorKind, String) {
    let begun = Instant::now();
    let error = expanded(body).unwrap_err();
    assert!(begun.elapsed() < Duration::from_secs(60), "{:?} for {error}", begun.elapsed());
    (error.kind(), error.to_string())
}

#[test]
fn files_outside_of_the_packages_are_refused() {
    let outside = tempdir().unwrap();
    write(outside.path(), "a.xacro", "<robot><a/></robot>");
    write(outside.path(), "a.yaml", "a: 1");
    let path = outside.path().display();
    let name = outside.path().file_name().unwrap().to_string_lossy().into_owned();
    for body in [
        format!("<xacro:include filename='{path}/a.xacro'/>"),
        format!("<xacro:include filename='file://{path}/a.xacro'/>"),
        format!("<xacro:include filename='../{name}/a.xacro'/>"),
        format!("<xacro:include filename='../{name}/*.xacro'/>"),
        format!("<xacro:include filename='{path}/a.xacro' optional='true'/>"),
        format!("<e a=\"${{xacro.load_yaml('../{name}/a.yaml')}}\"/>"),
    ] {
        let (kind, text) = refused(&body);
        assert_eq!(kind, ErrorKind::Unsupported, "{text}");
        assert!(text.contains("outside of the description's folder"), "{text}");
    }
}

#[cfg(unix)]
#[test]
fn symbolic_links_do_not_leave_the_packages() {
    let (outside, folder) = (tempdir().unwrap(), described("<xacro:include filename='link.xacro'/>"));
    write(outside.path(), "a.xacro", "<robot><a/></robot>");
    std::os::unix::fs::symlink(outside.path().join("a.xacro"), folder.path().join("link.xacro")).unwrap();
    let error = expand(&folder, &ReadOptions::new()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported, "{error}");
    expand(&folder, &ReadOptions::new().package("other", outside.path())).unwrap();
}

#[test]
fn environment_variables_are_not_read() {
    for body in ["<e a='$(env HOME)'/>", "<e a=\"$(eval env('HOME'))\"/>", "<e a='$(cwd)'/>"] {
        assert_eq!(refused(body).0, ErrorKind::Unsupported, "{body}");
    }
}

#[test]
fn expansions_have_limits() {
    let doubled: String = (0..40)
        .map(|n| format!("<xacro:macro name='m{}' params=''><xacro:m{n}/><xacro:m{n}/></xacro:macro>", n + 1))
        .collect();
    let lists: String =
        (0..60).map(|n| format!("<xacro:property name='p{}' value='${{[p{n}, p{n}]}}'/>", n + 1)).collect();
    let texts: String =
        (0..60).map(|n| format!("<xacro:property name='p{}' value='${{p{n}}}${{p{n}}}'/>", n + 1)).collect();
    let chain: String = (0..2000).map(|n| format!("<xacro:property name='p{}' value='${{p{n}}}'/>", n + 1)).collect();
    let blocks = "<xacro:macro name='m' params='*b'><xacro:m><c><xacro:insert_block name='b'/><xacro:insert_block name='b'/></c></xacro:m></xacro:macro><xacro:m><b/></xacro:m>";
    for body in [
        "<xacro:macro name='m'><xacro:m/></xacro:macro><xacro:m/>".to_owned(),
        "<xacro:macro name='m' params='n'><a><xacro:m n='${n + 1}'/></a></xacro:macro><xacro:m n='0'/>".to_owned(),
        "<xacro:include filename='robot.xacro'/>".to_owned(),
        format!("<xacro:macro name='m0' params=''><a/></xacro:macro>{doubled}<xacro:m40/>"),
        format!("<xacro:macro name='m0' params=''/>{doubled}<xacro:m40/>"),
        format!("<xacro:property name='p0' value='${{[1]}}'/>{lists}<e a='${{p60}}'/>"),
        format!("<xacro:property name='p0' value='${{[1]}}'/>{lists}<e a='${{p60 == p60}}'/>"),
        format!("<xacro:property name='p0' value='text'/>{texts}<e a='${{p60}}'/>"),
        format!("<xacro:property name='p0' value='text'/>{chain}<e a='${{p2000}}'/>"),
        blocks.to_owned(),
        "<e a=\"${'a' * 10**9}\"/>".to_owned(),
        "<e a=\"${[1] * 10**30}\"/>".to_owned(),
        "<e a='${list(range(10**12))}'/>".to_owned(),
        "<e a='${2**10**9}'/>".to_owned(),
        "<e a='${10**38 * 10}'/>".to_owned(),
        "<e a=\"${'%999999999s' % 1}\"/>".to_owned(),
        "<e a='${[[[0 for a in range(1000)] for b in range(1000)] for c in range(1000)]}'/>".to_owned(),
        format!("<e a='${{{}1{}}}'/>", "(".repeat(5000), ")".repeat(5000)),
        format!("<e a='${{{}1}}'/>", "-".repeat(5000)),
        format!("<e a='${{1{}}}'/>", " + 1".repeat(4000)),
        format!("<e a='${{{}}}'/>", "1".repeat(30_000)),
    ] {
        let (kind, text) = refused(&body);
        assert!([ErrorKind::BadValue, ErrorKind::Syntax, ErrorKind::Unsupported].contains(&kind), "{text}");
    }
}

/// The deepest allowed nesting needs less than the stack of a thread.
#[test]
fn the_deepest_descriptions_fit_on_a_stack() {
    let loops = "<xacro:macro name='m' params='n'><xacro:if value='${n > 0}'><a n='${n}'/><xacro:m n='${n - 1}'/></xacro:if></xacro:macro>";
    expanded(&format!("{loops}<xacro:m n='100'/>")).unwrap();
    let chain: String =
        (0..100).map(|n| format!("<xacro:property name='p{}' value='${{p{n} + 1}}'/>", n + 1)).collect();
    let text = expanded(&format!("<xacro:property name='p0' value='1'/>{chain}<e a='${{p100}}'/>")).unwrap().text;
    assert!(text.contains("<e a=\"101\"/>"), "{text}");
}

#[test]
fn errors_have_their_place_and_that_of_the_call() {
    let folder = described("\n<xacro:include filename='m.xacro'/>\n\n<xacro:outer/>");
    let text = "<robot>\n<xacro:macro name='inner' params='x'>\n<a>\n<b v='${x + nothing}'/></a></xacro:macro>\n\
        <xacro:macro name='outer' params=''>\n<xacro:inner x='1'/></xacro:macro></robot>";
    write(folder.path(), "m.xacro", text);
    let error = expand(&folder, &ReadOptions::new()).unwrap_err();
    assert_eq!((error.kind(), error.place().line), (ErrorKind::UnknownName, Some(4)), "{error}");
    assert!(error.place().file.as_ref().unwrap().ends_with("m.xacro"), "{error}");
    let message = error.message();
    assert!(message.contains("in `${x + nothing}`: `nothing` is not defined"), "{message}");
    let calls = [("inner", "m.xacro line 6"), ("outer", "robot.xacro line 4")];
    for (name, place) in calls {
        assert!(
            message.contains(&format!("in the macro `{name}`, called at ")) && message.contains(place),
            "{message}"
        );
    }
}

#[test]
fn what_is_no_description_is_refused_with_its_file() {
    for (text, kind) in [
        ("<robot>", ErrorKind::Syntax),
        ("<a/><b/>", ErrorKind::Syntax),
        ("", ErrorKind::Syntax),
        ("PK\x03\x04", ErrorKind::Unsupported),
    ] {
        let folder = described("<xacro:include filename='a.xacro'/>");
        fs::write(folder.path().join("a.xacro"), text).unwrap();
        let error = expand(&folder, &ReadOptions::new()).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.place().file.as_ref().unwrap().ends_with("a.xacro"), "{error}");
    }
    let folder = described("<e a=\"${xacro.load_yaml('a.yaml')}\"/>");
    fs::write(folder.path().join("a.yaml"), "a: [1\nb: 2").unwrap();
    let error = expand(&folder, &ReadOptions::new()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Syntax, "{error}");
    assert!(error.place().file.as_ref().unwrap().ends_with("a.yaml"), "{error}");
}
