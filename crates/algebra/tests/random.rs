//! The generator of pseudorandom numbers.

use groebot_algebra::random::SplitMix64;

/// The numbers of the reference implementation for the seed 1234567 (Rosetta Code, "Pseudo-random numbers/Splitmix64").
#[test]
fn words_are_those_of_the_reference() {
    let mut random = SplitMix64::new(1_234_567);
    let words = [
        6_457_827_717_110_365_317,
        3_203_168_211_198_807_973,
        9_817_491_932_198_370_423,
        4_593_380_528_125_082_431,
        16_408_922_859_458_223_821,
    ];
    assert_eq!(words.map(|_| random.word()), words);
}

#[test]
fn numbers_are_in_their_ranges() {
    let mut random = SplitMix64::new(0);
    for _ in 0..1000 {
        assert!(random.below(3) < 3);
        assert!((1..7).contains(&random.unit(7)));
        assert!((0.0..1.0).contains(&random.share()));
        let number = random.between(-2.0, 5.0);
        assert!(-2.0 < number && number <= 5.0);
    }
}
